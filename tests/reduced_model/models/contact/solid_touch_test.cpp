// When solids touch first, and how fast: against the first integral (4.2) and the film of (4.12),
// in all models that know the roughness.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/common/temporary_folder.hpp"
#include "tests/reduced_model/cases.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact_threshold.hpp"
#include "viscontact/reduced_model/models/inertial.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::reduced_model {
namespace {

constexpr double kSolidGap = 1e-3;

/// A sphere of radius and viscosity 1 that the force -1 presses to the wall from q0 = 1, slowly
/// enough that its inertia does not matter.
Motion pressed(double mass, double step) {
  Motion motion{mass, 1, 0, 300, ExternalForce({{300, -1}})};
  motion.roughness = {kSolidGap / 4, kSolidGap * 3 / 4};
  motion.set(kReferenceTimeStep, step);
  motion.set(kRelativeTolerance, 1e-11);
  motion.set(kContactTimeStep, step);
  motion.set(kThresholdGap, 0.1);
  return motion;
}

TEST(SolidTouch, OfAPressedSphereIsThatOfTheFirstIntegral) {
  const auto force = lubrication::LubricationForce::exact_plane(1, 1);
  const double impulse = force.impulse(1) - force.impulse(kSolidGap);
  const double velocity = -1 / force.resistance(kSolidGap);
  constexpr double kMass = 1e-3;
  for (const auto* model : {"inertial_rough", "viscous_contact_threshold"})
    for (const double step : {0.1, 0.37}) {
      SCOPED_TRACE(model);
      const auto touch =
          simulate(find_model(model), pressed(kMass, step), force).solid_contact_from;
      ASSERT_TRUE(touch);
      // m u + Gamma(q) = Gamma(q0) + P, where m u is 1e-8 of Gamma; in the threshold model the
      // sphere is at rest at the touch. The velocity of inertial_rough has a correction of the
      // order of m/R relative to the time of the fall, below 1e-6.
      EXPECT_NEAR(touch->time / impulse, 1, 1e-7);
      EXPECT_NEAR(touch->velocity / velocity, 1, 2e-6);
    }
}

TEST(SolidTouch, OfAPressedSphereWithoutDragAtADistanceIsThatOfTheFilm) {
  // With R = k/q the film of viscous contact is q0 exp(gamma/k): the impulse of the force until the
  // touch is k ln(q0/q_s), whenever the sphere lands, and dq/dt = -q f/k.
  const double k = 6 * std::numbers::pi;
  const lubrication::LubricationForce force(leading_term_fit(k));
  for (const auto* model : {"viscous_contact", "viscous_contact_exact", "viscous_contact_leapfrog"})
    for (const double step : {0.1, 0.37}) {
      SCOPED_TRACE(model);
      const auto touch = simulate(find_model(model), pressed(1, step), force).solid_contact_from;
      ASSERT_TRUE(touch);
      EXPECT_NEAR(touch->time / (k * std::log(1 / kSolidGap)), 1, 1e-12);
      EXPECT_NEAR(touch->velocity / (-kSolidGap / k), 1, 1e-12);
    }
}

/// A sphere that flies to the wall with the speed 1 and this Stokes number, without a force.
Motion shot(double stokes, double restitution, double step) {
  const double k = 6 * std::numbers::pi;
  Motion motion{stokes * k, 1, -1, 3, ExternalForce({{3, 0}})};
  motion.roughness = {0.01, 0};
  motion.set(kReferenceTimeStep, step);
  motion.set(kRelativeTolerance, 1e-11);
  motion.set(kContactTimeStep, step);
  motion.set(kRestitution, restitution);
  return motion;
}

TEST(SolidTouch, OfAnImpactHasTheVelocityThatTheFilmLeaves) {
  const lubrication::LubricationForce force(leading_term_fit(6 * std::numbers::pi));
  for (const auto* model :
       {"viscous_contact", "viscous_contact_exact", "viscous_contact_leapfrog", "inertial_rough"})
    for (const double restitution : {0.0, 0.9})
      for (const double step : {0.1, 0.037}) {
        SCOPED_TRACE(model);
        const double stokes = 27;
        const auto touch =
            simulate(find_model(model), shot(stokes, restitution, step), force).solid_contact_from;
        ASSERT_TRUE(touch);
        EXPECT_NEAR(touch->velocity, -1 + std::log(100) / stokes, 1e-9);
        if (std::string(model) != "inertial_rough") {
          EXPECT_NEAR(touch->time, 1, 1e-12);
        }
        // A film that is thick enough keeps the solids apart.
        EXPECT_FALSE(
            simulate(find_model(model), shot(1, restitution, step), force).solid_contact_from);
      }
  const auto dry = simulate(find_model("inelastic_contact"), shot(27, 0, 0.1), force);
  EXPECT_NEAR(dry.solid_contact_from.value().time, 1, 1e-12);
  EXPECT_NEAR(dry.solid_contact_from->velocity, -1, 1e-12);
}

TEST(SolidTouch, ConvergesWithTheTimeStep) {
  // An impact that the film nearly stops, under a force that then presses: both ways to the touch
  // are in the range of these masses.
  const double k = 6 * std::numbers::pi;
  const lubrication::LubricationForce force(leading_term_fit(k));
  for (const double mass : {20.0, 100.0, 400.0}) {
    auto motion = pressed(mass, 0.05);
    motion.initial_velocity = -1;
    motion.end_time = 200;
    const auto exact = simulate(find_model("viscous_contact_exact"), motion, force);
    ASSERT_TRUE(exact.solid_contact_from);
    for (const double step : {0.05, 0.005}) {
      motion.set(kContactTimeStep, step);
      for (const auto* model : {"viscous_contact", "viscous_contact_leapfrog"}) {
        const auto touch = simulate(find_model(model), motion, force).solid_contact_from.value();
        EXPECT_NEAR(touch.time, exact.solid_contact_from->time, step) << model << " " << mass;
        // The force changes the velocity of an impact by step/mass.
        EXPECT_NEAR(touch.velocity, exact.solid_contact_from->velocity, 2 * step / mass)
            << model << " " << mass;
      }
    }
  }
}

TEST(SolidTouch, IsMissingWhereNoSolidsAre) {
  const auto force = lubrication::LubricationForce::exact_plane(1, 1);
  auto motion = pressed(1, 0.1);
  for (const auto* model : {"inertial", "reference_exact", "viscous_contact_smooth"})
    EXPECT_FALSE(simulate(find_model(model), motion, force).solid_contact_from) << model;
  motion.roughness = {0, 0};
  EXPECT_FALSE(simulate(find_model("viscous_contact_threshold"), motion, force).solid_contact_from);
}

TEST(SolidTouch, IsInTheFilesOfTrajectoryAndComparison) {
  const TemporaryFolder folder;
  const auto force = lubrication::LubricationForce::exact_plane(1, 1);
  const auto smooth = simulate(find_model("inertial"), pressed(1, 0.5), force);
  const auto rough = simulate(find_model("inertial_rough"), pressed(1, 0.5), force);
  const auto read = read_trajectory(folder.file("rough.csv", write_trajectory(rough)));
  EXPECT_EQ(read.solid_contact_from, rough.solid_contact_from);
  EXPECT_FALSE(
      read_trajectory(folder.file("smooth.csv", write_trajectory(smooth))).solid_contact_from);
  const auto comparison = read_comparison(folder.file(
      "comparison.json", write_comparison(compare_trajectories({smooth, rough}, "inertial"))));
  EXPECT_FALSE(comparison.models.at(0).solid_contact_from);
  EXPECT_EQ(comparison.models.at(1).solid_contact_from, rough.solid_contact_from);
}

}  // namespace
}  // namespace viscontact::reduced_model
