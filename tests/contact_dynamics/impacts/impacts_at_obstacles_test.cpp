// Impacts at planes that move, jump or turn, and at round walls, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/contact_dynamics/impacts/scene.hpp"

namespace viscontact::particles {
namespace {

TEST(ImpactAtAnObstacle, FromAPlaneThatMovesIsThatOfTheRelativeVelocity) {
  auto scene = flying(2, 3, 1, 0.6, 0.013);
  scene.setting.laws.film.gamma_min = 0;
  scene.setting.planes[0].velocity = constant({0, 0.25, 0});
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 2);
  EXPECT_NEAR(simulation.state().particles.velocity(0)[1], 0.25 + 0.6 * 1.25, 1e-10);
}

TEST(ImpactAtAnObstacle, FromAPlaneThatStartsIsExactWhereverTheStepsLie) {
  // A disc at rest on a plane that starts to move at t = 1/3 is hit with the whole velocity, not
  // with its mean over the step in which the plane starts.
  for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
    for (const double step : {0.1, 0.013, 0.5}) {
      auto scene = flying(2, 3, 0, 0.6, step);
      scene.setting.scheme = scheme;
      scene.state.particles.velocities = {0, 0};
      scene.setting.laws.film.gamma_min = 0;
      scene.setting.planes[0].velocity = {{{1.0 / 3, {}}, {1e300, {0, 0.25, 0}}}};
      Simulation simulation(scene.setting, scene.state, 1);
      run(simulation, 2);
      EXPECT_NEAR(simulation.state().particles.velocity(0)[1], 1.6 * 0.25, 1e-10) << step;
      EXPECT_NEAR(simulation.state().particles.position(0)[1], 1 + 0.4 * (2 - 1.0 / 3), 1e-10);
      EXPECT_NEAR(simulation.state().time, 2, 1e-12);
    }
}

TEST(ImpactAtAnObstacle, FromAPlaneWhoseVelocityJumpsInAStepOfTheLeapfrogIsExact) {
  for (const double step : {0.1, 0.01}) {
    auto scene = flying(2, 3, 1.21, 1, step);
    scene.setting.scheme = Scheme::kLeapfrog;
    scene.setting.laws.film.gamma_min = 0;
    scene.state.particles.velocities = {0, -5};
    scene.setting.planes[0].velocity = {{{0.25, {}}, {1e300, {0, 1, 0}}}};
    // The impact is at t = 0.242, before the plane starts.
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 1);
    EXPECT_NEAR(simulation.state().particles.velocity(0)[1], 5, 1e-10) << step;
    EXPECT_NEAR(simulation.state().particles.position(0)[1], 1 + 5 * (1 - 0.242), 1e-9) << step;
  }
}

/// A disc of radius 1/2 in a circle of radius 3 at rest, without a film.
Scene in_circle(const Vector& centre, const Vector& velocity, double dry, double step) {
  Scene scene{no_particles(2), {}};
  add_particle(scene.state, centre, 0.5, 1, velocity);
  scene.setting.planes = {Plane{}};
  scene.setting.planes[0].start = {{}, {}, 3};
  scene.setting.laws.film.gamma_min = 0;
  scene.setting.laws.restitution.coefficient = dry;
  scene.setting.time_step = step;
  return scene;
}

TEST(ImpactAtAnObstacle, AtARoundWallKeepsEnergyAndAngularMomentum) {
  for (const double step : {2.0, 0.1, 0.03}) {
    const double angle = 1.1;
    auto scene = in_circle({2.4, 0, 0}, {-std::cos(angle), std::sin(angle), 0}, 1, step);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto rebounds = rebounds_until(200, simulation);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(norm(p.velocity(0)), 1, 1e-12) << step;
    EXPECT_NEAR(cross(p.position(0), p.velocity(0))[2], 2.4 * std::sin(angle), 1e-9) << step;
    // The chords between impacts are equally long.
    const double half = std::sqrt(6.25 - 2.4 * 2.4 * std::sin(angle) * std::sin(angle));
    ASSERT_GT(rebounds.size(), 50U);
    for (std::size_t k = 0; k < rebounds.size(); ++k)
      EXPECT_NEAR(rebounds[k].time, half + 2.4 * std::cos(angle) + 2 * half * double(k), 1e-9);
  }
  // A single oblique impact, at (1.5, 2).
  auto scene = in_circle({-0.053, 2, 0}, {1, 0, 0}, 1, 0.1);
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 2);
  EXPECT_NEAR(simulation.state().particles.velocity(0)[0], 0.28, 1e-12);
  EXPECT_NEAR(simulation.state().particles.velocity(0)[1], -0.96, 1e-12);
}

TEST(ImpactAtAnObstacle, EndsWhereADiscSlidesAlongARoundWall) {
  for (const double step : {0.01, 0.003}) {
    auto scene = in_circle({2.4999, 0, 0}, {-0.4535961, 0.8912074, 0}, 0.5, step);
    Simulation simulation(scene.setting, scene.state, 1);
    EXPECT_GT(rebounds_until(6, simulation).size(), 3U);
    EXPECT_TRUE(rebounds_until(20, simulation).empty()) << step;
  }
}

TEST(ImpactAtAnObstacle, OnAPlaneThatTurnsIsThatOfItsSurface) {
  // An impact at (10, 1) on the floor that turns about the origin, at the time at which the disc
  // meets it.
  constexpr double kOmega = 0.5, kDry = 0.7, kSpeed = 2;
  for (const double step : {0.5, 0.1, 0.013}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {10, 3, 0}, 1, 1, {0, -kSpeed, 0});
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    scene.setting.planes[0].angular_velocity = {0, 0, kOmega};
    scene.setting.laws.film.gamma_min = 0;
    scene.setting.laws.restitution.coefficient = kDry;
    scene.setting.time_step = step;
    Simulation simulation(scene.setting, scene.state, 1);
    std::vector<Rebound> rebounds;
    while (rebounds.empty()) {
      ASSERT_LT(simulation.state().time, 1);
      simulation.step(1);
      rebounds.assign(simulation.rebounds().begin(), simulation.rebounds().end());
    }
    const double t = rebounds[0].time, angle = kOmega * t;
    const Vector normal{-std::sin(angle), std::cos(angle), 0}, place{10, 3 - kSpeed * t, 0};
    EXPECT_NEAR(dot(normal, place), 1, 1e-10) << step;
    const Vector surface = cross(Vector{0, 0, kOmega}, place - normal);
    const double approach = dot(normal, Vector{0, -kSpeed, 0} - surface);
    EXPECT_NEAR(rebounds[0].approach_velocity, approach, 1e-9);
    const Vector after = Vector{0, -kSpeed, 0} - (1 + kDry) * approach * normal;
    EXPECT_LE(norm(simulation.state().particles.velocity(0) - after), 1e-9) << step;
  }
}

TEST(ImpactAtAnObstacle, AtAPlaneThatTurnsRubsOnThePointOfContact) {
  // The disc sticks to the point of the plane that is 0.25 below the pivot.
  Scene scene{no_particles(2), {}};
  add_particle(scene.state, {0, 0.501, 0}, 0.5, 1, {0, -5, 0});
  add_rotation(scene.state.particles);
  scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
  scene.setting.planes[0].angular_velocity = {0, 0, 1};
  scene.setting.planes[0].pivot = {0, 0.25, 0};
  scene.setting.laws.film.gamma_min = 0;
  scene.setting.laws.friction = FrictionLaw{50};
  scene.setting.laws.restitution.coefficient = 0.5;
  scene.setting.time_step = 1e-3;
  Simulation simulation(scene.setting, scene.state, 1);
  run(simulation, 0.002);
  // 2/3 of the slip is left of the motion and 4/3 of it over the diameter of the rotation.
  EXPECT_NEAR(simulation.state().particles.velocity(0)[0], 0.25 / 3, 2e-3);
  EXPECT_NEAR(simulation.state().particles.angular_velocities[0], 1.0 / 3, 2e-3);
}

TEST(ImpactAtAnObstacle, EndsOnAPlaneThatTurnsAndCarriesADisc) {
  for (const double step : {0.01, 0.0025}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {1, 0.3, 0}, 0.3, 1, {-0.3, 1, 0});
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    scene.setting.planes[0].angular_velocity = {0, 0, 1};
    scene.setting.laws.film.gamma_min = 0;
    scene.setting.laws.restitution.coefficient = 0.3;
    scene.setting.time_step = step;
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 1);
    EXPECT_TRUE(rebounds_until(3, simulation).empty()) << step;
    // The distance from the pivot along the plane is cosh t. Errors of the projection, of first
    // order in the step, grow as fast.
    EXPECT_NEAR(norm(simulation.state().particles.position(0)), std::hypot(std::cosh(3), 0.3),
                20 * step);
  }
}

}  // namespace
}  // namespace viscontact::particles
