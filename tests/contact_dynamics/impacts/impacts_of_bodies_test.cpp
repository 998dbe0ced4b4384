// Impacts of rigid bodies, of one contact and of several, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/contact_dynamics/impacts/scene.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

TEST(ImpactOfABody, OfAFlatDumbbellAtTheEndOfAStepIsOneImpact) {
  // It arrives at t = 2 h but for rounding errors, in scenes that are turned.
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.37 + 0.37 * k;
    const Vector n{-std::sin(angle), std::cos(angle), 0}, t{n[1], -n[0], 0};
    Scene scene{no_particles(2), {}};
    for (const double side : {-0.55, 0.55})
      add_particle(scene.state, side * t + 0.7 * n, 0.5, 1, -1.0 * n);
    auto& p = scene.state.particles;
    add_rotation(p);
    add_rigid_body(p, {.members = {0, 1}});
    scene.setting.planes = {plane_at_rest({}, n)};
    set_rebounds_without_film(scene.setting, 1, 0.1);
    Simulation simulation(scene.setting, scene.state, 1);
    run(simulation, 1.5);
    const auto& body = simulation.state().particles.bodies.bodies[0];
    EXPECT_NEAR(dot(n, body.velocity), 1, 1e-12) << angle;
    EXPECT_NEAR(body.angular_velocity[2], 0, 1e-12) << angle;
  }
}

TEST(ImpactOfABody, OfABodyThatTurnsKeepsItsEnergyAtEachStep) {
  for (const double step : {0.04, 0.01, 0.0025}) {
    Scene scene{no_particles(2), {}};
    add_particle(scene.state, {0.477668, 2.147760, 0}, 0.3, 1, {-0.443280, 0.433005, 0});
    add_particle(scene.state, {-0.477668, 1.852240, 0}, 0.3, 1, {0.443280, -2.433005, 0});
    auto& p = scene.state.particles;
    add_rotation(p);
    p.angular_velocities = {3, 3};
    add_rigid_body(p, {.members = {0, 1}});
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    set_rebounds_without_film(scene.setting, 1, step);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto energy_of = [](const RigidBody& body) {
      return body.mass * dot(body.velocity, body.velocity) / 2 +
             body.inertia[8] * body.angular_velocity[2] * body.angular_velocity[2] / 2;
    };
    const double before = energy_of(simulation.state().particles.bodies.bodies[0]);
    EXPECT_FALSE(rebounds_until(1.3, simulation).empty());
    EXPECT_NEAR(energy_of(simulation.state().particles.bodies.bodies[0]), before, 1e-9 * before)
        << step;
  }
}

TEST(ImpactOfABody, TwiceInAStepKeepsTheEnergyAndHasTheVelocityOfThePointOfContact) {
  // The ends of a dumbbell hit the plane one after the other within one step, between which the
  // first impact has turned it.
  constexpr double kRadius = 0.5, kHalf = 1.5, kStep = 0.02;
  Random random(5);
  int twice = 0;
  for (int k = 0; k < 300; ++k) {
    const double tilt = random.uniform(-0.02, 0.02), turns = random.uniform(-8, 8), falls = -3;
    const Vector centre{0, kRadius + kHalf * std::abs(std::sin(tilt)) + random.uniform(0, 0.03), 0};
    Scene scene{no_particles(2), {}};
    auto& p = scene.state.particles;
    for (const double side : {-kHalf, kHalf}) {
      const Vector arm{side * std::cos(tilt), side * std::sin(tilt), 0};
      add_particle(scene.state, centre + arm, kRadius, random.uniform(0.5, 2),
                   Vector{0, falls, 0} + cross(Vector{0, 0, turns}, arm));
    }
    add_rotation(p);
    p.angular_velocities = {turns, turns};
    add_rigid_body(p, {.members = {0, 1}});
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    set_rebounds_without_film(scene.setting, 1, kStep);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto before = simulation.state().particles.bodies.bodies[0];
    double speed = before.velocity[1], turning = before.angular_velocity[2], angle = 0, last = 0;
    simulation.step(kStep);
    const auto& after = simulation.state().particles.bodies.bodies[0];
    if (simulation.rebounds().size() > 1) ++twice;
    for (const auto& rebound : simulation.rebounds()) {
      angle += turning * (rebound.time - last);
      last = rebound.time;
      const Vector offset = before.offsets[std::size_t(rebound.second)];
      const double arm = std::cos(angle) * offset[0] - std::sin(angle) * offset[1];
      const double approach = speed + turning * arm;
      // An impact is solved to 1e-13 of its velocities (kExact in impact_solution.cpp), which are
      // up to 20, and a second impact multiplies its errors.
      EXPECT_NEAR(rebound.approach_velocity, approach, 1e-10) << k;
      EXPECT_NEAR(rebound.velocity, -approach, 1e-10) << k;
      const double impulse = -2 * approach / (1 / before.mass + arm * arm / before.inertia[8]);
      speed += impulse / before.mass;
      turning += arm * impulse / before.inertia[8];
    }
    EXPECT_NEAR(after.velocity[1], speed, 1e-10) << k;
    EXPECT_NEAR(after.angular_velocity[2], turning, 1e-10) << k;
  }
  EXPECT_GT(twice, 20);
}

TEST(ImpactOfABody, InSpaceKeepsTheEnergyToSecondOrder) {
  // Bodies of three unequal spheres, whose angular velocity changes in free flight, too. Returns
  // the mean change of the energy by a step with an impact.
  const auto mean_change = [](double step) {
    Random random(6);
    double sum = 0;
    int impacts = 0;
    for (int k = 0; k < 100; ++k) {
      Scene scene{no_particles(3), {}};
      auto& p = scene.state.particles;
      const Vector spin = 5.0 * random.direction(3), falls{0, 0, -3};
      const std::array<Vector, 3> places{random.direction(3), random.direction(3), Vector{}};
      for (const auto& place : places)
        add_particle(scene.state, place + Vector{0, 0, 1.6}, 0.5, random.uniform(0.5, 2),
                     falls + cross(spin, place));
      add_rotation(p);
      for (std::size_t i = 0; i < 9; ++i) p.angular_velocities[i] = spin[i % 3];
      add_rigid_body(p, {.members = {0, 1, 2}});
      scene.setting.planes = {plane_at_rest({}, {0, 0, 1})};
      set_rebounds_without_film(scene.setting, 1, step);
      Simulation simulation(scene.setting, scene.state, 1);
      const auto energy = [&] {
        const auto& body = simulation.state().particles.bodies.bodies[0];
        return (body.mass * dot(body.velocity, body.velocity) +
                dot(body.angular_momentum, body.angular_velocity)) /
               2;
      };
      double before = energy();
      run(simulation, 1, [&](const StepReport&) {
        const double after = energy();
        if (!simulation.rebounds().empty()) {
          sum += std::abs(after / before - 1);
          ++impacts;
        }
        before = after;
      });
    }
    EXPECT_GT(impacts, 100);
    return sum / impacts;
  };
  const double coarse = mean_change(0.01), fine = mean_change(0.0025);
  // It is 9e-5, and would be 2e-3 if impacts took the mean angular velocity of the step.
  EXPECT_LE(coarse, 1e-4);
  EXPECT_LE(fine, coarse / 10);  // 16 for the second order
}

TEST(ImpactOfABody, AcrossAPeriodicSideIsThatInTheMiddle) {
  // A dumbbell that turns, and a disc that falls on it, at different places of a periodic cell.
  std::vector<Rebound> in_middle;
  for (const double shift : {5.0, 0.1, 9.2, 8.7}) {
    Scene scene{no_particles(2), {}};
    scene.setting.domain = BoxDomain{{0, 0}, {10, 10}, {true, false}};
    auto& p = scene.state.particles;
    p.cell = cell_of(scene.setting);
    const auto add = [&](double x, double y, const Vector& velocity) {
      add_particle(scene.state, {std::fmod(shift + x + 10, 10), y, 0}, 0.5, 1, velocity);
    };
    add(-0.6, 3, {0.3, -1.2, 0});
    add(0.6, 3, {0.3, 1.2, 0});
    add(1.1, 4.5, {0, -3, 0});
    add_rotation(p);
    p.angular_velocities = {2, 2, 0};
    add_rigid_body(p, {.members = {0, 1}});
    set_rebounds_without_film(scene.setting, 0.8, 0.05);
    Simulation simulation(scene.setting, scene.state, 1);
    const auto rebounds = rebounds_until(2, simulation);
    if (in_middle.empty()) in_middle = rebounds;
    EXPECT_FALSE(rebounds.empty());
    ASSERT_EQ(rebounds.size(), in_middle.size()) << shift;
    // Rounding errors of positions up to 10.
    for (std::size_t k = 0; k < rebounds.size(); ++k) {
      EXPECT_NEAR(rebounds[k].time, in_middle[k].time, 1e-12) << shift;
      EXPECT_NEAR(rebounds[k].approach_velocity, in_middle[k].approach_velocity, 1e-12) << shift;
      EXPECT_NEAR(rebounds[k].velocity, in_middle[k].velocity, 1e-12) << shift;
    }
  }
}

TEST(ImpactOfABody, OfABodyThatFallsFlatDoesNotDependOnTheOrderOfItsParticles) {
  // Five discs of which each takes a fifth of the impact, 0.8 of it in its film and 0.2 in its
  // solids.
  std::vector<std::size_t> order{0, 1, 2, 3, 4};
  do {
    Scene scene{no_particles(2), {}};
    for (const auto k : order)
      add_particle(scene.state, {2.0 * static_cast<double>(k), 1.5, 0}, 1, 1, {0, -1, 0});
    scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
    scene.setting.laws.film.gamma_min = -0.8;
    scene.setting.laws.restitution.coefficient = 0.8;
    scene.setting.time_step = 0.3;
    auto& p = scene.state.particles;
    add_rotation(p);
    add_rigid_body(p, {.members = {0, 1, 2, 3, 4}});
    Simulation simulation(scene.setting, scene.state, 1);
    std::vector<Rebound> rebounds;
    run(simulation, 1.5, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged);
      rebounds.insert(rebounds.end(), simulation.rebounds().begin(), simulation.rebounds().end());
    });
    ASSERT_EQ(rebounds.size(), 5U);
    for (const auto& rebound : rebounds) {
      EXPECT_NEAR(rebound.solid_impulse, 0.2, 1e-10);
      EXPECT_EQ(rebound.velocity, 0);
    }
  } while (std::ranges::next_permutation(order).found);
}

TEST(ImpactOfABody, OfARigidBodyHasItsMassAndInertia) {
  // A dumbbell along x falls on its left disc: the contact sees the mass 1/(1/m + r^2/I).
  Scene scene{no_particles(2), {}};
  add_particle(scene.state, {0, 1.5, 0}, 1, 1, {0, -1, 0});
  add_particle(scene.state, {4, 5.5, 0}, 1, 1, {0, -1, 0});
  auto& p = scene.state.particles;
  add_rotation(p);
  add_rigid_body(p, {.members = {0, 1}});
  scene.setting.planes = {plane_at_rest({}, {0, 1, 0})};
  set_rebounds_without_film(scene.setting, 0.7, 0.0173);
  Simulation simulation(scene.setting, scene.state, 1);
  const auto body = p.bodies.bodies[0];
  run(simulation, 0.6);
  // The left disc is at -(2, 2) from the centre; the impulse J along y turns by -2 J.
  const double w = 1 / body.mass + 4 / body.inertia[8];
  const double impulse = 1.7 / w;
  const auto& after = simulation.state().particles.bodies.bodies[0];
  EXPECT_NEAR(after.velocity[1], -1 + impulse / body.mass, 1e-9);
  EXPECT_NEAR(after.angular_velocity[2], -2 * impulse / body.inertia[8], 1e-9);
}

}  // namespace
}  // namespace viscontact::particles
