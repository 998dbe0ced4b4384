// Motions between two walls, which end at the wall opposite, and the numbers that say in which
// regime a motion is.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/lubrication/regime.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {
namespace {

using lubrication::AboveInterval;
using lubrication::BelowInterval;

constexpr double kPi = std::numbers::pi;

/// R = k (1/q + 1/r) up to the gap 2 on a sphere of radius 2, with the lid of a cylinder at the gap
/// 8.
lubrication::Fit fit_below_lid() {
  auto fit = leading_term_fit(24 * kPi);
  fit.radius = 2;
  fit.viscosity = 1;
  fit.gap_interval = {1e-3, 2};
  fit.terms.push_back({"1", 12 * kPi, 0, false});
  fit.covariance.assign(2, std::vector<double>(2, 0.0));
  fit.geometry = "plane";
  fit.container = "closed cylinder, radius 20, height 12";
  return fit;
}

/// A sphere that a constant force lifts from the gap 1.
Motion lifted(double force, double end, double step) {
  Motion motion{20, 1, 0, end, ExternalForce({{end, force}})};
  motion.set(kReferenceTimeStep, step);
  motion.set(kContactTimeStep, step);
  motion.set(kRelativeTolerance, 1e-9);
  motion.set(kThresholdGap, 0.1);
  motion.set(kRestitution, 0);
  return motion;
}

class MotionToTheLid : public ::testing::TestWithParam<std::string> {};

TEST_P(MotionToTheLid, EndsThere) {
  const lubrication::LubricationForce force(
      fit_below_lid(), {BelowInterval::kLubricationLimit, AboveInterval::kStokesLimit});
  for (const double push : {400.0, 4000.0})
    for (const double restitution : {0.0, 0.5}) {
      auto motion = lifted(push, 40, 0.01);
      if (restitution > 0) {
        motion.roughness = {0.01, 0};
        motion.set(kRestitution, restitution);
      }
      const auto trajectory = simulate(find_model(GetParam()), motion, force);
      for (const auto& row : trajectory.rows) ASSERT_LT(row.gap, 8) << row.time;
      const auto& last = trajectory.rows.back();
      EXPECT_LT(last.time, 40);
      EXPECT_NEAR(last.gap, 8, 1e-7);
      EXPECT_TRUE(reached_wall(trajectory, motion, force.largest_gap()).has_value());
      // The balances of the budget hold for the part of the motion that there is.
      const auto& b = trajectory.budget.value();
      const double inertia = GetParam().starts_with("reference") ? 0 : 20;
      EXPECT_NEAR(b.external_impulse + b.film_impulse + b.drag_impulse + b.solid_impulse,
                  inertia * last.velocity, 1e-9 * b.external_impulse);
    }
}

INSTANTIATE_TEST_SUITE_P(Models, MotionToTheLid,
                         ::testing::Values("reference_exact", "inertial", "viscous_contact",
                                           "viscous_contact_regular_drag",
                                           "viscous_contact_threshold", "viscous_contact_exact",
                                           "viscous_contact_leapfrog", "inelastic_contact",
                                           "inertial_rough", "inertial_brenner",
                                           "viscous_contact_threshold_brenner"));

TEST(MotionToTheLidOf, LightSpheresFollowsTheFirstIntegral) {
  // Without inertia the lid's film has the impulse of the force: the models with a small mass and
  // without one agree on the gap of each time until the end.
  const lubrication::LubricationForce force(
      fit_below_lid(), {BelowInterval::kLubricationLimit, AboveInterval::kStokesLimit});
  auto motion = lifted(400, 12, 0.05);
  motion.mass = 1e-6;
  const auto exact = simulate(find_model("reference_exact"), motion, force);
  const auto inertial = simulate(find_model("inertial"), motion, force);
  EXPECT_GT(exact.rows.back().gap, 8 - 1e-3);
  const auto rows = std::min(exact.rows.size(), inertial.rows.size());
  ASSERT_GT(rows, 50U);
  // The tolerance of CVODE, and the inertia: 1e-6 of it times velocities of 10.
  for (std::size_t i = 0; i < rows; ++i)
    EXPECT_NEAR(inertial.rows[i].gap, exact.rows[i].gap, 1e-6) << exact.rows[i].time;
}

TEST(MotionToTheLidOf, ASphereThatStartsBeyondItIsRefused) {
  const lubrication::LubricationForce force(
      fit_below_lid(), {BelowInterval::kLubricationLimit, AboveInterval::kStokesLimit});
  auto motion = lifted(400, 1, 0.01);
  motion.initial_gap = 8;
  for (const auto* model : {"inertial", "viscous_contact", "inelastic_contact"})
    EXPECT_THAT(bad_input([&] { simulate(find_model(model), motion, force); }),
                Names("initial_gap"));
}

TEST(Regime, HasTheNumbersOfAFallingBead) {
  // Terminal velocity far from walls: mu = 1e-3, r = 1.5 mm, of a bead of 2500 kg/m3 in water.
  const double r = 1.5e-3, mu = 1e-3, volume = 4 * kPi / 3 * r * r * r, g = 9.81;
  const double speed = 1500 * volume * g / (6 * kPi * mu * r);
  Motion motion{2500 * volume, 1, -speed, 0.05, ExternalForce({{0.05, -1500 * volume * g}})};
  motion.set(kReferenceTimeStep, 1e-3);
  motion.set(kContactTimeStep, 1e-3);
  motion.set(kRelativeTolerance, 1e-9);
  motion.fluid_density = 1000;
  const auto force = lubrication::LubricationForce::exact_plane(mu, r);
  auto trajectory = simulate(find_model("inertial"), motion, force);
  // At 600 radii from the plane the drag is 0.2 % larger, which acts for a part of the time of
  // relaxation, 1.25 s.
  EXPECT_NEAR(trajectory.reynolds_number.value() / (1000 * 2 * r * speed / mu), 1, 1e-3);
  EXPECT_NEAR(trajectory.stokes_number.value() / (2500 * volume * speed / (6 * kPi * mu * r * r)),
              1, 1e-3);
  EXPECT_EQ(regime_warnings({trajectory}).size(), 1U);
  motion.fluid_density = 0;
  EXPECT_FALSE(simulate(find_model("inertial"), motion, force).reynolds_number.has_value());
  trajectory.reynolds_number = 0.1;
  EXPECT_THAT(regime_warnings({trajectory}), ::testing::IsEmpty());
  EXPECT_NEAR(lubrication::drag_over_stokes(0.1), 1.0308, 1e-4);
  EXPECT_NEAR(24 / 500.0 * lubrication::drag_over_stokes(500), 0.562, 1e-3);
}

TEST(Regime, NamesFilmsInWhichInertiaPlaysNoPart) {
  // A constant force on a rough sphere at rest at the gap r; k = 1, R = k/q + k/r.
  auto fit = leading_term_fit(1);
  fit.gap_interval = {1e-4, 2};
  fit.terms.push_back({"1", 1, 0, false});
  fit.radius = 1;
  fit.viscosity = 1 / (6 * kPi);
  fit.covariance.assign(2, std::vector<double>(2, 0.0));
  const lubrication::LubricationForce force(fit, {BelowInterval::kLubricationLimit});
  for (const auto& [mass, warned] : {std::pair{1e-3, true}, {1000.0, false}}) {
    const double end = 8 + 3 * std::sqrt(mass);
    Motion motion{mass, 1, 0, end, ExternalForce({{end, -1}})};
    motion.roughness = {1e-3, 0};
    motion.set(kReferenceTimeStep, end / 4000);
    motion.set(kContactTimeStep, end / 4000);
    motion.set(kRelativeTolerance, 1e-9);
    motion.set(kRestitution, 0);
    const auto contact = simulate(find_model("viscous_contact"), motion, force);
    const auto true_touch =
        simulate(find_model("inertial_rough"), motion, force).solid_contact_from.value().time;
    const double error = contact.solid_contact_from.value().time / true_touch - 1;
    EXPECT_EQ(regime_warnings({contact}).size(), warned ? 1U : 0U) << mass;
    // docs/studies.md#regimes: 13 % too early for light spheres, 2 % for heavy ones.
    EXPECT_NEAR(error, warned ? -0.126 : -0.02, 0.005) << mass;
    const auto resolved = simulate(find_model("viscous_contact_regular_drag"), motion, force);
    EXPECT_FALSE(resolved.film_stokes_number.has_value());
  }
}

TEST(Rebounds, HaveVelocitiesOfTheMotionAndAreNotThoseOfASphereThatStays) {
  // A light bead settles on its roughness under a constant force: its film, not its inertia, stops
  // it, and it is thrown back by less than the film takes.
  const lubrication::LubricationForce force =
      lubrication::LubricationForce::exact_plane(1 / (6 * kPi), 1);
  for (const double mass : {0.05, 0.5, 100.0}) {
    const double end = 12 + 4 * std::sqrt(mass);
    Motion motion{mass, 1, 0, end, ExternalForce({{end, -1}})};
    motion.roughness = {1e-2, 0};
    motion.set(kReferenceTimeStep, 1e-2);
    motion.set(kRelativeTolerance, 1e-9);
    motion.set(kRestitution, 0.9);
    const auto trajectory = simulate(find_model("inertial_rough"), motion, force);
    double fastest = 0;
    for (const auto& row : trajectory.rows) fastest = std::min(fastest, row.velocity);
    std::size_t stays = 0;
    ASSERT_FALSE(trajectory.rebounds.empty());
    for (const auto& rebound : trajectory.rebounds) {
      // The fastest row may miss the fastest instant between two rows.
      EXPECT_GE(rebound.approach_velocity, fastest * 1.01);
      EXPECT_LT(rebound.approach_velocity, 0);
      EXPECT_LE(rebound.coefficient, 0.9 + 1e-12);
      stays += rebound.velocity == 0 ? 1 : 0;
    }
    EXPECT_LE(stays, 1U) << mass;
    if (mass < 1) {
      EXPECT_EQ(trajectory.rebounds.size(), 1U) << mass;
    }
    if (mass > 10) {
      EXPECT_GT(trajectory.rebounds.front().velocity, 0) << mass;
    }
  }
}

}  // namespace
}  // namespace viscontact::reduced_model
