// simulate_inertial against an integration of the equation of motion in extended precision
// (tests/oracles/inertial_motion.hpp), which does not use its first integral.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/oracles/inertial_motion.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"

namespace viscontact::reduced_model {
namespace {

using Real = long double;

/// The force of the code and the oracle's R.
struct Drag {
  lubrication::LubricationForce force;
  InertialProblem::Function resistance;
};

Drag exact_plane(double viscosity) {
  return {lubrication::LubricationForce::exact_plane(viscosity, 1),
          exact_plane_resistance(viscosity, 1)};
}

Drag fitted(const lubrication::Fit& fit,
            lubrication::BelowInterval below = lubrication::BelowInterval::kError) {
  return {lubrication::LubricationForce(fit, {below}), [fit](Real q) {
            Real force = 0;
            for (const auto& term : fit.terms) {
              const Real log = term.name.find("ln q") == std::string::npos ? 0 : std::log(q);
              const Real function = term.name == "1/q"      ? 1 / q
                                    : term.name == "1"      ? 1
                                    : term.name == "q"      ? q
                                    : term.name == "q^2"    ? q * q
                                    : term.name == "q^3"    ? q * q * q
                                    : term.name == "ln q"   ? log
                                    : term.name == "q ln q" ? q * log
                                                            : std::nanl("");
              force += term.coefficient * function;
            }
            return -force / fit.reference_velocity;
          }};
}

/// f of the code and the oracle's.
struct Push {
  ExternalForce force;
  std::vector<InertialProblem::Piece> pieces;
};

Push steps(const std::vector<ExternalForce::Piece>& pieces) {
  Push push{ExternalForce(pieces), {}};
  Real from = 0;
  for (const auto& piece : pieces) {
    push.pieces.push_back({piece.until, [piece, from](Real t) {
                             Real value = 0;
                             for (auto c = piece.higher.rbegin(); c != piece.higher.rend(); ++c)
                               value = (value + *c) * (t - from);
                             return value + piece.value;
                           }});
    from = piece.until;
  }
  return push;
}

Push operator+(Push push, const ExternalForce::Sinusoid& s) {
  push.force += ExternalForce::sinusoidal(s);
  for (auto& piece : push.pieces)
    piece.force = [before = piece.force, s](Real t) {
      return before(t) +
             s.amplitude * std::sin(static_cast<Real>(s.angular_frequency) * t + s.phase);
    };
  return push;
}

/// The largest error so far, and when.
struct Worst {
  Real error = 0, time = 0;
  void see(Real now, Real at) {
    // A NaN counts too.
    if (!(now <= error)) error = now, time = at;
  }
};

constexpr Real kGapBar = 1e-8L;       // what `inertial` is to reach at both tolerances, relative
constexpr Real kVelocityBar = 1e-5L;  // (P - Gamma)/m has the error of ln q times k/m: three digits
                                      // less than the gap in these cases

/// f at `time`; at a jump, before it, as the oracle has its state there.
Real force_at(const Push& push, Real time) {
  return std::ranges::find_if(push.pieces, [&](const auto& piece) { return time <= piece.until; })
      ->force(time);
}

struct Start {
  double mass, gap = 1, velocity = 0;
};

/// Every tenth row and those about a jump, at tolerances of 1e-9 and 1e-11.
void expect_the_oracles_motion(const Start& start, const Drag& drag, const Push& push) {
  for (const double tolerance : {1e-9, 1e-11}) {
    SCOPED_TRACE(tolerance);
    Motion motion{start.mass, start.gap, start.velocity,
                  static_cast<double>(push.pieces.back().until), push.force};
    motion.set(kReferenceTimeStep, 1e-3);
    motion.set(kRelativeTolerance, tolerance);
    const auto trajectory = simulate_inertial(motion, drag.force);
    InertialMotion oracle({start.mass, start.gap, start.velocity, drag.resistance, push.pieces});
    const auto jumps = push.force.jumps();
    const auto times = row_times(motion);
    Worst gap, velocity;
    for (std::size_t i = 1; i < trajectory.rows.size(); ++i) {
      const auto& row = trajectory.rows[i];
      const bool near_jump = std::ranges::any_of(
          jumps, [&](double jump) { return std::abs(row.time - jump) < 3.5e-3; });
      if (i % 10 != 0 && !near_jump && i + 1 != trajectory.rows.size()) continue;
      oracle.advance(row.time);
      gap.see(std::abs(row.gap / oracle.gap() - 1), row.time);

      // A row between those asked for is where the sphere turns. After a jump a thin film turns
      // within the rounding of its time.
      if (!std::ranges::binary_search(times, row.time)) continue;

      // Where the sphere turns no digit of u is left: beside u itself counts what it would be
      // without inertia, or what it changes by until the next row, whichever is less; and what
      // would move the sphere by a millionth of the gap in all the time there is.
      const Real u = oracle.velocity(), r = drag.resistance(oracle.gap());
      const Real f = force_at(push, row.time), acceleration = std::abs(f - r * u) / start.mass;
      const Real scale =
          std::abs(u) +
          std::min(std::abs(f) / r, motion.parameter(kReferenceTimeStep) * acceleration) +
          1e-6L * oracle.gap() / motion.end_time;
      velocity.see(std::abs(row.velocity - u) / scale, row.time);
    }
    EXPECT_LT(gap.error, kGapBar) << "t = " << gap.time;
    EXPECT_LT(velocity.error, kVelocityBar) << "t = " << velocity.time;
  }
}

const Push kLecture = steps({{2, -200}, {4, 200}});

TEST(InertialAccuracy, OfTheLecturesCaseWithTheExactDrag) {
  expect_the_oracles_motion({.mass = 20}, exact_plane(3), kLecture);
}

TEST(InertialAccuracy, OfTheLecturesCaseWithTheLecturesBasis) {
  expect_the_oracles_motion({.mass = 20}, fitted(lecture_fit()), kLecture);
}

TEST(InertialAccuracy, OfTheLecturesCaseWithTheAsymptoticBasis) {
  expect_the_oracles_motion({.mass = 20}, fitted(close_fit()), kLecture);
}

TEST(InertialAccuracy, OfPushesDownTo1e12And1e15And1e23) {
  expect_the_oracles_motion({.mass = 20}, exact_plane(3), steps({{2, -800}, {4, 800}}));
  expect_the_oracles_motion({.mass = 20}, exact_plane(3), steps({{2, -1000}, {4.5, 900}}));
  expect_the_oracles_motion({.mass = 20}, exact_plane(1), steps({{2, -500}, {4.5, 480}}));
}

TEST(InertialAccuracy, OfALightSphere) {
  // m/R from 2e-8 down to 5e-11, and to 1e-21.
  expect_the_oracles_motion({.mass = 1e-6}, exact_plane(3), kLecture);
  expect_the_oracles_motion({.mass = 1e-6}, exact_plane(3), steps({{2, -900}, {4, 900}}));
  expect_the_oracles_motion({.mass = 1e-3}, exact_plane(3), kLecture);
}

TEST(InertialAccuracy, OfASphereThatFliesUntilItLands) {
  // m/R = 5 to 1e3 far away. In flight R is nothing; landing, ln q runs at up to 1e7.
  expect_the_oracles_motion({.mass = 1}, exact_plane(5e-3), steps({{2, -2}, {6, 2}}));
  expect_the_oracles_motion({.mass = 1000, .velocity = -1}, exact_plane(5),
                            steps({{2, -200}, {6, 800}}));
  expect_the_oracles_motion({.mass = 1}, fitted(shifted_fit(0.1)), steps({{2, -2}, {6, 2}}));
  expect_the_oracles_motion({.mass = 1}, fitted(leading_term_fit(0.1)), steps({{2, -2}, {6, 2}}));
}

TEST(InertialAccuracy, OfASphereThatStartsFast) {
  expect_the_oracles_motion({.mass = 1000, .velocity = -0.3}, exact_plane(3),
                            steps({{2, -20}, {6, 100}}));
  expect_the_oracles_motion({.mass = 20, .gap = 0.3, .velocity = -30}, exact_plane(3),
                            steps({{0.5, -50}, {1.25, 120}, {1.5, 0}, {3, -80}}));
  expect_the_oracles_motion({.mass = 20, .gap = 1e-2, .velocity = 5}, exact_plane(3), kLecture);
}

TEST(InertialAccuracy, OfForcesThatVary) {
  expect_the_oracles_motion(
      {.mass = 20}, exact_plane(3),
      steps({{1, -100, {-50, 30}}, {2.5, -200, {20}}, {4, 150, {0, 10, -3}}}) +
          ExternalForce::Sinusoid{50, 7, 0.3});
  expect_the_oracles_motion({.mass = 1e-3}, exact_plane(3),
                            steps({{4, -10}}) + ExternalForce::Sinusoid{100, std::numbers::pi, 1});
  expect_the_oracles_motion({.mass = 2}, exact_plane(3),
                            steps({{1, 0, {-100}}, {4, -100, {100}}}) +
                                ExternalForce::Sinusoid{300, 60, 0} +
                                ExternalForce::Sinusoid{20, 3, 1});
}

// The oracle itself.

InertialProblem lecture_problem() {
  return {20, 1, 0, exact_plane_resistance(3, 1), kLecture.pieces};
}

InertialProblem limit_problem(Real k) {
  return {1, 1, 0, [k](Real q) { return k / q; }, steps({{2, -2}, {6, 2}}).pieces};
}

TEST(InertialOracle, AgreesWithTheLimitCaseStates) {
  const auto path =
      std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/reference/limit_case_states.csv";
  const std::array<std::string, 4> columns = {"mu", "t", "ln_q", "u"};
  for (const auto& [k, exactly] : {std::pair{1.0, 1.0L}, {0.1, 0.1L}, {0.01, 0.01L}}) {
    InertialMotion motion(limit_problem(exactly));
    for (const auto& row : read_csv(path, columns, columns.size()).rows) {
      if (row.fields[0] != k) continue;
      motion.advance(*row.fields[1]);
      const Real log_gap = *row.fields[2], velocity = *row.fields[3];
      // The file has 14 digits of ln q, 13 of u; but its u at mu = 0.1, t = 3 is P - mu ln q in
      // double, 6e-17 off (1.6e-9 of u).
      EXPECT_NEAR(static_cast<double>(motion.log_gap() - log_gap), 0,
                  1e-13 * std::max(1.0, std::abs(static_cast<double>(log_gap))))
          << k << ", t = " << motion.time();
      EXPECT_NEAR(static_cast<double>(motion.velocity() - velocity), 0,
                  1e-12 * std::abs(static_cast<double>(velocity)) + 1e-16)
          << k << ", t = " << motion.time();
    }
  }
}

TEST(InertialOracle, KeepsTheFirstIntegralThatItDoesNotUse) {
  for (const Real k : {1.0L, 0.1L, 0.01L}) {
    InertialMotion motion(limit_problem(k));
    for (int i = 1; i <= 60; ++i) {
      motion.advance(i / 10.0L);
      const Real momentum = i <= 20 ? -i / 5.0L : -4 + (i - 20) / 5.0L;
      // 1e-15 of |P| <= 4 is asked of it; 7e-17 was the largest.
      EXPECT_LT(std::abs(motion.velocity() + k * motion.log_gap() - momentum), 1e-15L)
          << k << ", t = " << motion.time();
    }
  }
}

TEST(InertialOracle, IsTheSameAtTwoTolerances) {
  InertialMotion loose(lecture_problem(), 1e-13L), tight(lecture_problem(), 1e-17L);
  for (int i = 1; i <= 40; ++i) {
    loose.advance(i / 10.0L);
    tight.advance(i / 10.0L);
    // Round-off: the tolerances bound the error of a whole step, and the halves are kept.
    EXPECT_LT(std::abs(loose.log_gap() - tight.log_gap()), 1e-15L) << i;
    EXPECT_LT(std::abs(loose.velocity() / tight.velocity() - 1), 1e-14L) << i;
  }
}

TEST(InertialOracle, HasTheLecturesMinimalGap) {
  InertialMotion motion(lecture_problem());
  motion.advance(2);
  const auto lowest = advanced_to_turn(motion, 2.1L);
  EXPECT_NEAR(static_cast<double>(lowest.gap()), kInertialMinimalGap, 0.5e-11);  // its last digit
  EXPECT_NEAR(static_cast<double>(lowest.time()), kInertialMinimalGapTime, 0.5e-8);
}

}  // namespace
}  // namespace viscontact::reduced_model
