// The studies that are shipped as cases (docs/studies.md) show what they say: each is read as
// `viscontact run` reads it.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/reduced_model/cases.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {
namespace {

using ::testing::Contains;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// A shipped case with its drag.
struct Study {
  case_file::Case c;
  lubrication::LubricationForce force;

  const Motion& motion() const { return case_file::required_motion(c); }

  /// One of the models that the case runs, with another motion or drag if asked.
  Trajectory run(const std::string& model, const Motion& changed,
                 const lubrication::LubricationForce& drag) const {
    EXPECT_THAT(c.models, Contains(model));
    return simulate(find_model(model), changed, drag);
  }
  Trajectory run(const std::string& model, const Motion& changed) const {
    return run(model, changed, force);
  }
  Trajectory run(const std::string& model) const { return run(model, motion()); }
};

Study study(const char* name) {
  case_file::Case c =
      case_file::read_case(std::filesystem::path(VISCONTACT_SOURCE_FOLDER) / "data/cases" / name);
  const auto& fit = case_file::required_fit(c);
  lubrication::LubricationForce force =
      fit.exact
          ? lubrication::LubricationForce::exact_plane(c.viscosity, c.radius)
          : lubrication::LubricationForce(lubrication::read_fit(fit.file.value()), fit.outside);
  return {std::move(c), std::move(force)};
}

double landing(const Trajectory& trajectory) { return trajectory.contact_interval.value()[0]; }
double release(const Trajectory& trajectory) { return trajectory.contact_interval.value()[1]; }

/// The first row whose load the solids carry.
const TrajectoryRow& touch(const Trajectory& trajectory) {
  return *std::ranges::find_if(trajectory.rows,
                               [](const auto& row) { return *row.solid_force > 0; });
}

TEST(NoContact, ThePushThinsTheFilmForEver) {
  const Study s = study("no_contact.toml");
  const auto trajectory = s.run("inertial");
  for (const auto& row : trajectory.rows) EXPECT_GT(row.gap, 0) << row.time;
  const auto& end = trajectory.rows.back();
  EXPECT_EQ(end.time, 20);
  // m u = -2 m q/k, 3e-17, is nothing beside Gamma = -40; relative_tolerance 1e-9 bounds the error
  // of ln q.
  EXPECT_NEAR(std::log(end.gap), std::log(s.force.gap_of_impulse(-40)), 1e-8);
  EXPECT_NEAR(std::log(end.gap), -38.7384, 5e-5);  // as printed
  // ln q = -2 t/k + C as soon as the drag is k/q and the velocity nothing: at t = 10 to 1e-8, q (ln
  // q) being 7e-9 x 19.
  EXPECT_NEAR(std::log(row_at(trajectory, 10).gap), std::log(end.gap) + 20, 1e-6);
}

TEST(NoContact, ExplicitEulerGoesThroughThePlaneWhenItsStepSaysSo) {
  const Study s = study("no_contact.toml");
  Motion motion = s.motion();
  EXPECT_EQ(motion.parameter(kContactTimeStep), 1e-3);
  const std::array times = {std::pair(1e-2, 3.76), std::pair(1e-3, 4.58), std::pair(1e-4, 5.63)};
  for (const auto& [step, time] : times) {
    motion.set(kContactTimeStep, step);
    const auto trajectory = s.run("explicit_euler", motion);
    const auto& last = trajectory.rows.back();
    EXPECT_EQ(last.gap, 0) << step;
    // What grows is rounding: another last digit of q0 makes it 0.01 to 0.02 earlier or later.
    EXPECT_NEAR(last.time, time, 0.05) << step;
    // The film that the motion has there is in the unstable range, q < h k/(2 m).
    EXPECT_LT(s.force.gap_of_impulse(-2 * last.time), step / 2) << step;
  }
}

TEST(ViscousOrNot, ThePlainOneLeavesWhenItIsPulledTheViscousOneWhenAllIsGivenBack) {
  const Study s = study("viscous_or_not.toml");
  const double h = s.motion().parameter(kContactTimeStep);
  const auto viscous = s.run("viscous_contact");
  const auto plain = s.run("inelastic_contact");
  EXPECT_NEAR(landing(viscous), 1, h);
  EXPECT_NEAR(landing(plain), 1, h);
  // Impulses are exact, and so is when they are given back: round-off of 5000 sums.
  EXPECT_NEAR(release(viscous), 4, 1e-9);
  EXPECT_NEAR(release(plain), 2, 1e-9);
  // (t - 4)^2 and (t - 2)^2, to the scheme's h (t - 4), h (t - 2).
  EXPECT_NEAR(viscous.rows.back().gap, 1, 1.01 * h);
  EXPECT_NEAR(plain.rows.back().gap, 9, 3.01 * h);
}

TEST(ViscousOrNot, TheViscousOneIsTheSphereWithInertia) {
  const Study s = study("viscous_or_not.toml");
  const auto inertial = s.run("inertial");
  const auto viscous = s.run("viscous_contact");
  const auto plain = s.run("inelastic_contact");
  const double thinnest = lowest_row(inertial).gap;
  // gamma = -4 and k = 0.1. The momentum of a film of that thickness is nothing.
  EXPECT_NEAR(std::log(thinnest), -40, 1e-7);
  EXPECT_NEAR(std::log(viscous.film_from_gamma.value()), -40, 1e-9);
  EXPECT_NEAR(inertial.rows.back().gap, 1.1564, 5e-5);  // as printed; 1 in the limit
  EXPECT_LT(inertial.rows.back().gap - viscous.rows.back().gap, 0.2);
  EXPECT_GT(plain.rows.back().gap - inertial.rows.back().gap, 7);
}

TEST(Roughness, StopsGammaAndTheSolidCarriesTheRest) {
  const Study s = study("roughness.toml");
  // k = 6 pi mu r^2, m = 20, f = -200 until 2, r1 + r2 = 0.01: gamma = -200 t while pushed.
  const double k = s.force.leading_coefficient();
  const double gamma_min = k * std::log(0.01);
  EXPECT_NEAR(gamma_min, -260.4162, 5e-5);  // as printed
  const auto rough = s.run("viscous_contact_exact");
  const auto smooth = s.run("viscous_contact_exact_smooth");
  constexpr double kRoundOff = 1e-13;  // of times of size 4
  EXPECT_NEAR(landing(rough), std::sqrt(0.2), kRoundOff);
  EXPECT_NEAR(touch(rough).time, -gamma_min / 200, kRoundOff);  // 1.3021
  EXPECT_NEAR(touch(rough).time, 1.3021, 5e-5);
  EXPECT_EQ(*touch(rough).solid_force, 200);
  EXPECT_NEAR(release(rough), 2 - gamma_min / 200, kRoundOff);  // 3.3021
  EXPECT_NEAR(release(smooth), 4, kRoundOff);
  EXPECT_NEAR(rough.film_from_gamma.value(), 0.01, 1e-15);
  EXPECT_NEAR(smooth.film_from_gamma.value(), std::exp(-400 / k), 1e-15);
  // Of the push's 400 the film takes -gamma_min, the solid the rest; the film gives back what it
  // took.
  EXPECT_NEAR(rough.budget->solid_impulse, 400 + gamma_min, 1e-10);
  EXPECT_NEAR(rough.budget->solid_impulse, 139.5838, 5e-5);
  EXPECT_NEAR(rough.budget->film_impulse, 0, 1e-10);
  EXPECT_EQ(smooth.budget->solid_impulse, 0);
}

TEST(Roughness, DoesTheSameWhereTheDragIsResolvedDownToAThreshold) {
  const Study s = study("roughness.toml");
  const auto rough = s.run("viscous_contact_threshold");
  const auto smooth = s.run("viscous_contact_threshold_smooth");
  const double at_solid = s.force.impulse(0.01);
  const double h = s.motion().parameter(kContactTimeStep);
  // By the first integral the film is 0.01 thick when the push has brought -Gamma(0.01) = 330.6:
  // the solid carries the rest of 400.
  EXPECT_NEAR(touch(rough).time, -at_solid / 200, h);
  EXPECT_NEAR(rough.budget->solid_impulse, 400 + at_solid, 1e-9);
  EXPECT_NEAR(rough.budget->solid_impulse, 69.4272, 5e-5);
  const double from_threshold = s.force.impulse(s.motion().parameter(kThresholdGap)) - at_solid;
  EXPECT_NEAR(release(rough), 2 + from_threshold / 200, 1e-9);
  EXPECT_NEAR(rough.film_from_gamma.value(), 0.01, 1e-14);
  EXPECT_NEAR(smooth.film_from_gamma.value(), kExactMinimalGap, 5e-12);  // its digits
  EXPECT_GT(release(smooth), release(rough) + 0.3);
  EXPECT_EQ(smooth.budget->solid_impulse, 0);
}

TEST(Release, TheRoughSphereForgetsThePushTheSmoothOneDoesNot) {
  const Study s = study("release.toml");
  EXPECT_NEAR(s.force.leading_coefficient() * std::log(0.01), -2, 8 * kEpsilon);
  for (const double push : {1.0, 2.0, 4.0, 30.0, 1000.0}) {
    Motion motion = s.motion();
    motion.end_time = 2 * push + 2;
    motion.external_force = ExternalForce({{push, -2}, {motion.end_time, 2}});
    motion.set(kContactTimeStep, motion.end_time / 1000);  // of rows, not of the answer
    const auto rough = s.run("viscous_contact_exact", motion);
    const auto smooth = s.run("viscous_contact_exact_smooth", motion);
    // Times of size 2 push, impulses of twice that.
    const double round_off = 64 * kEpsilon * push;
    EXPECT_NEAR(landing(rough), 0.5, round_off) << push;
    EXPECT_NEAR(release(rough), push + 1, round_off) << push;
    EXPECT_NEAR(release(smooth), 2 * push, round_off) << push;
    const auto pull = [&](double until) {
      return motion.external_force.impulse(until) - motion.external_force.impulse(push);
    };
    EXPECT_NEAR(pull(release(rough)), 2, 2 * round_off) << push;
    EXPECT_NEAR(pull(release(smooth)), 2 * push, 2 * round_off) << push;
    EXPECT_NEAR(rough.budget->solid_impulse, 2 * push - 2, 4 * round_off) << push;
  }
}

TEST(Splitting, TheThresholdHasTheFilmOfTheFirstIntegral) {
  const Study s = study("splitting.toml");
  for (const std::string suffix : {"", "_brenner"}) {
    const auto exact = s.run("reference_exact" + suffix);
    const auto threshold = s.run("viscous_contact_threshold" + suffix);
    // Relative 1e-11: round-off of 2000 sums of impulses of 400 is 1e-13 to 1e-12 of them, 7 times
    // that in ln q.
    EXPECT_NEAR(threshold.film_from_gamma.value() / lowest_row(exact).gap, 1, 1e-11) << suffix;
  }
  EXPECT_NEAR(lowest_row(s.run("reference_exact_brenner")).gap, kExactMinimalGap, 5e-12);
  EXPECT_NEAR(lowest_row(s.run("reference_exact")).gap, 2.9598e-3, 5e-8);  // theory.md, section 2
}

TEST(Splitting, TheRegularDragLeavesOutWhatItHasNotTaken) {
  const Study s = study("splitting.toml");
  const auto brenner = s.run("viscous_contact_regular_drag_brenner");
  const auto force = lubrication::LubricationForce::exact_plane(s.c.viscosity, s.c.radius);
  // m u + G(q) + gamma = P with G(1) - G(0) taken on the way: q = r exp((G(1) - 400)/k), where (I)
  // has G(1) - G(q_min).
  const double expected = std::exp((force.regular_impulse(1) - 400) / force.leading_coefficient());
  EXPECT_NEAR(brenner.film_from_gamma.value() / expected, 1, 1e-11);
  EXPECT_NEAR(expected, 2.9915e-3, 5e-8);
  // What the lecture prints for this model.
  EXPECT_EQ(fmt::format("{:.0e}", expected), "3e-03");
  EXPECT_NEAR(s.run("viscous_contact_regular_drag").film_from_gamma.value(), 2.9724e-3, 5e-8);
}

TEST(Splitting, IsAsGoodAsTheSphereWithInertiaAllows) {
  const Study s = study("splitting.toml");
  // Relative tolerance 1e-9, and the digits of the constant.
  EXPECT_NEAR(lowest_row(s.run("inertial_brenner")).gap / kInertialMinimalGap, 1, 1e-8);
  EXPECT_NEAR(lowest_row(s.run("inertial")).gap, 2.9673e-3, 5e-8);
}

/// The times of the rows where contact begins and ends, in turn.
std::vector<double> contact_times(const Trajectory& trajectory) {
  std::vector<double> times;
  bool contact = false;
  for (const auto& row : trajectory.rows) {
    if ((*row.gamma < 0) != contact) times.push_back(row.time);
    contact = *row.gamma < 0;
  }
  return times;
}

TEST(AnyForce, MakesAndLosesContactWhereItsImpulsesSaySo) {
  const Study s = study("any_force.toml");
  const auto& f = s.motion().external_force;
  const auto times = contact_times(s.run("viscous_contact_exact"));
  const std::array<double, 7> printed = {0.8938, 1.9168, 4.4535, 6.9328, 8.3795, 10.9681, 12.5381};
  ASSERT_EQ(times.size(), printed.size());
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_NEAR(times[i], printed[i], 5e-5) << i;
  // Without solids m u + gamma is the impulse of f: 0 at a release. From there to the next landing
  // the way sums up to 0; to the first it is -q0.
  EXPECT_NEAR(f.impulse_integral(times[0]), -s.motion().initial_gap, 1e-12);
  for (std::size_t i = 1; i < times.size(); i += 2) {
    EXPECT_NEAR(f.impulse(times[i]), 0, 1e-12) << i;
    EXPECT_NEAR(f.impulse_integral(times[i + 1]), f.impulse_integral(times[i]), 1e-12) << i;
  }
}

TEST(AnyForce, TheSphereWithInertiaTendsToItAsTheDragVanishes) {
  const Study s = study("any_force.toml");
  const auto exact = s.run("viscous_contact_exact");
  const auto distance = [&](double viscosity) {
    const auto inertial =
        s.run("inertial", s.motion(), lubrication::LubricationForce::exact_plane(viscosity, 1));
    double sup = 0;
    auto row = exact.rows.begin();
    for (const auto& at : inertial.rows) {
      while (row->time < at.time - 1e-9) ++row;
      // A row of one that the other has not is at most a step away, in which a gap changes by 1e-2.
      sup = std::max(sup, std::abs(at.gap - row->gap));
    }
    return sup;
  };
  const double here = distance(s.c.viscosity);
  EXPECT_NEAR(here, 0.072, 0.002);
  // As k ln k: by ln 0.01/(2 ln 0.02) = 0.59. (Films at a tenth of k are thinner than a double can
  // hold.)
  EXPECT_LT(distance(s.c.viscosity / 2), 0.6 * here);
}

}  // namespace
}  // namespace viscontact::reduced_model
