#include "viscontact/reduced_model/models/inertial.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/reduced_model/models/reference.hpp"

namespace viscontact::reduced_model {
namespace {

TEST(Inertial, HasARowWhereItTurns) {
  const auto trajectory =
      simulate_inertial(lecture_motion(), lubrication::LubricationForce(lecture_fit()));
  const auto lowest = lowest_row(trajectory);
  const double fastest = std::abs(std::ranges::max(trajectory.rows, {}, [](const auto& row) {
                                    return std::abs(row.velocity);
                                  }).velocity);
  // At the turn the velocity goes through 0 at rate f/R = 0.01 per unit of time; the event is found
  // to 1e-14 or so in time.
  EXPECT_LT(std::abs(lowest.velocity), 1e-10 * fastest);
  EXPECT_LT(lowest.gap, row_at(trajectory, 2).gap);
}

TEST(Inertial, TakesStopsThatDifferByRoundingForOne) {
  // CVODE refuses an interval shorter than two roundings of its ends.
  const double last = std::nextafter(0.3, 1);
  ASSERT_EQ(0.1 + 0.2, last);
  Motion motion = lecture_motion();
  motion.end_time = 4;
  motion.external_force = ExternalForce({{0.3, -200}, {4, 100}});
  const lubrication::LubricationForce force(leading_term_fit(50));
  const auto plain = simulate_inertial(motion, force);
  auto sum = ExternalForce({{0.3, -150}, {4, 50}});
  sum += ExternalForce({{last, -50}, {4, 50}});
  EXPECT_EQ(sum.jumps().size(), 1U);
  for (const auto& jumps : {sum, ExternalForce({{0.3, -200}, {last, -30}, {4, 100}})}) {
    motion.external_force = jumps;
    const auto split = simulate_inertial(motion, force);
    // The jump is later by one rounding.
    EXPECT_NEAR(split.rows.back().gap / plain.rows.back().gap, 1, 1e-9);
  }
  motion.external_force = ExternalForce({{0.3, -200}, {4, 100}});
  for (const double end : {last, std::nextafter(last, 1)}) {
    motion.end_time = end;
    EXPECT_NO_THROW(simulate_inertial(motion, force));
  }
}

TEST(Inertial, HasRowsAtEveryStepAndJump) {
  Motion motion = lecture_motion();
  motion.external_force = ExternalForce({{1.00005, -200}, {2, -100}, {4, 200}});
  const auto trajectory = simulate_inertial(
      motion, lubrication::LubricationForce(lecture_fit(),
                                            {lubrication::BelowInterval::kLubricationLimit}));
  for (const double time : row_times(motion)) EXPECT_EQ(row_at(trajectory, time).time, time);
  EXPECT_EQ(row_at(trajectory, 1.00005).external_force, -100);
  EXPECT_EQ(std::ranges::adjacent_find(trajectory.rows, std::ranges::greater_equal(),
                                       &TrajectoryRow::time),
            trajectory.rows.end());
}

TEST(Inertial, StartsExactlyWhereItIsTold) {
  Motion motion = lecture_motion();
  motion.initial_gap = 0.3;  // not exp(log(0.3))
  motion.initial_velocity = -0.7;
  const auto first =
      simulate_inertial(motion, lubrication::LubricationForce(leading_term_fit(50))).rows.front();
  EXPECT_EQ(first.gap, 0.3);
  EXPECT_EQ(first.velocity, -0.7);
}

TEST(Inertial, TendsToTheInertialessMotionAtFirstOrderInTheMass) {
  const lubrication::LubricationForce force(close_fit());
  Motion motion = lecture_motion();
  const double massless = lowest_row(simulate_reference_exact(motion, force)).gap;
  const auto excess = [&](double mass) {
    motion.mass = mass;
    return lowest_row(simulate_inertial(motion, force)).gap / massless - 1;
  };
  // For small m the film is thicker by m |u_0| / k at t = 2 (first integral), u_0 = f q/k: 2.6e-3
  // at m = 20, with a next term of that size.
  const double heavy = excess(20);
  const double light = excess(2);
  EXPECT_GT(light, 0);
  EXPECT_NEAR(std::log10(heavy / light), 1, 5e-3);
}

/// Compares with the exact states of the lecture's limit case, d2q/dt2 = -mu u/q + f.
void expect_limit_case_states(double mu) {
  const auto path =
      std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/reference/limit_case_states.csv";
  const std::array<std::string, 4> columns = {"mu", "t", "ln_q", "u"};
  const auto trajectory =
      simulate_inertial(limit_motion(), lubrication::LubricationForce(leading_term_fit(mu)));
  int compared = 0;
  for (const auto& state : read_csv(path, columns, columns.size()).rows) {
    if (state.fields[0] != mu) continue;
    ++compared;
    const auto& row = row_at(trajectory, *state.fields[1]);
    // Ten times relative_tolerance = 1e-9, in ln q and in time: where the film forms, ln q runs at
    // u/q = -325 (mu = 0.01, t = 1).
    const double rate = row.velocity / row.gap;
    EXPECT_NEAR(std::log(row.gap), *state.fields[2], 1e-8 * (1 + std::abs(rate)))
        << "t = " << row.time;
    // u = q w, and w is as far off as ln q is; u is printed to 1e-12 of the largest, 4.
    EXPECT_NEAR(row.velocity, *state.fields[3],
                1e-8 * (1 + std::abs(rate)) * std::abs(row.velocity) + 4e-12)
        << "t = " << row.time;
  }
  EXPECT_EQ(compared, 6);
}

TEST(Inertial, AgreesWithTheLimitCase) { expect_limit_case_states(1); }

TEST(Inertial, AgreesWithTheLimitCaseDownToAFilmOfTenToTheMinus18) {
  expect_limit_case_states(0.1);
}

TEST(Inertial, AgreesWithTheLimitCaseDownToAFilmOfTenToTheMinus174) {
  expect_limit_case_states(0.01);
}

TEST(Inertial, MeetsASharpToleranceInAThinFilm) {
  // The sphere turns within 1e-17 of the jump, less than a double tells apart from t = 2.
  Motion motion = limit_motion();
  motion.set(kRelativeTolerance, 1e-11);
  const auto trajectory =
      simulate_inertial(motion, lubrication::LubricationForce(leading_term_fit(0.1)));
  // limit_case_states.csv, mu = 0.1, t = 6; u/q is of order 1 there, the landing forgotten.
  EXPECT_NEAR(std::log(trajectory.rows.back().gap), 1.4043050385501, 1e-10);
}

TEST(Inertial, FollowsItsTolerance) {
  const lubrication::LubricationForce force(leading_term_fit(1));
  const double exact = 1.3040396304076;  // limit_case_states.csv, mu = 1, t = 6
  const auto error = [&](double tolerance) {
    Motion motion = limit_motion();
    motion.set(kRelativeTolerance, tolerance);
    return std::abs(std::log(simulate_inertial(motion, force).rows.back().gap) - exact);
  };
  for (const double tolerance : {1e-5, 1e-7, 1e-9, 1e-11})
    EXPECT_LT(error(tolerance), 10 * tolerance) << tolerance;
}

TEST(Inertial, SaysWhenItLeavesTheFit) {
  const lubrication::LubricationForce force(brenner_fit("lecture", {1e-2, 2}));
  EXPECT_THAT(bad_input([&] { simulate_inertial(lecture_motion(), force); }), Names("0.01", "2"));
}

}  // namespace
}  // namespace viscontact::reduced_model
