// Which loads bound the friction of contacts with films in the convex method, docs/physics.md
// (5.17): those of the first of two solutions, or those that the problem keeps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/constraints/constraint_solver.hpp"

namespace viscontact::particles {
namespace {

TEST(GivenLoads, BecomeThoseOfASolutionUnlessTheProblemKeepsThem) {
  // A disc of mass 1 and radius 1 slides at the velocity (1, -1) on a floor, in a step of length 1.
  // Its film takes 0.4 of the impulse 1 that stops it, whatever the friction is.
  const double friction = 0.3, capacity = 0.4, given = 0.5;
  for (const bool keeps_loads : {false, true}) {
    ConstraintProblem<2> problem;
    problem.is_convex = true;
    problem.keeps_loads = keeps_loads;
    const std::array<double, 2> moves{1, -1};
    const double turn = 0;
    problem.units.push_back(unit_of_particle<2>(1, 2, moves.data(), &turn));
    ConstraintBlock block;
    block.rows = 2;
    block.friction = friction;
    block.capacity = capacity;
    block.friction_bound = FrictionBound::kGiven;
    block.given_load = given;
    block.allowed = block.allowed_slip = 1e-9;
    problem.blocks.push_back(block);
    for (const Vector& direction : {Vector{0, 1, 0}, Vector{1, 0, 0}}) {
      const std::vector<RowPart<2>> parts{{0, displacement_row<2>(direction, {0, -1, 0})}};
      problem.add_row(0, parts, 0);
    }
    EXPECT_LE(solve_constraints(problem, 1000).result.residual, 1);
    // The accuracy of interior points is 1e-9 of the free motion.
    const double load = keeps_loads ? given : 1 - capacity;
    EXPECT_NEAR(problem.blocks[0].given_load, load, 1e-8);
    EXPECT_NEAR(problem.impulses[0], 1, 1e-8);
    EXPECT_NEAR(problem.impulses[1], -friction * load, 1e-8);
  }
}

/// Settings and states for 2 and 3 dimensions.
class GivenLoadsOfSteps : public testing::TestWithParam<int> {
 protected:
  static Setting setting_with(double h, double mu_s, double gamma_min, FrictionMethod method) {
    Setting setting;
    setting.time_step = h;
    setting.laws.film.gamma_min = gamma_min;
    setting.laws.friction = FrictionLaw{mu_s, method};
    return setting;
  }
  /// The angular velocity of particle 0 about the axis at right angles to the plane [1].
  static double spin(const State& state) {
    const auto& w = state.particles.angular_velocities;
    return state.particles.dimension == 3 ? w[2] : w[0];
  }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, GivenLoadsOfSteps, testing::Values(2, 3));

TEST_P(GivenLoadsOfSteps, ALandingAtAnySpeedHasTheFrictionOfItsLoad) {
  // Friction takes 0.3 of the part of the impulse that the film does not take. Loads of a rough
  // solution would not do: it is accurate to 1e-2 of the largest motion without impulses, which may
  // be that of the slip, and it is the guess if a motion is below 5e-4 mean radii.
  const double h = 0.01, mu = 0.3;
  for (const double along : {2.0, 50.0, 200.0})
    for (const double down : {1.0, 0.02}) {
      SCOPED_TRACE(along);
      SCOPED_TRACE(down);
      auto setting = setting_with(h, mu, -down / 2, FrictionMethod::kConvex);
      setting.planes = {plane_at_rest({}, {0, 1, 0})};
      State state = no_particles(GetParam());
      add_particle(state, {0, 1, 0}, 1, 1, {along, -down, 0});
      add_rotation(state.particles);
      Simulation simulation(setting, state, 1);
      run(simulation, 5 * h, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
      const double lost = along - simulation.state().particles.velocity(0)[0];
      EXPECT_NEAR(lost, mu * down / 2, 1e-6 * along);
    }
}

TEST_P(GivenLoadsOfSteps, AParticleInACornerWithoutASolutionHasTheFrictionOfALoadWithoutFriction) {
  // The belt drives the particle into the corner. Without friction the load of the belt is m g h
  // and that of the wall is 0, so that friction turns the particle by mu_s g h r m/I in a step.
  const double h = 0.01, g = 1, inertia = GetParam() == 3 ? 0.4 : 0.5;
  for (const double mu_s : {1.1, 1.5, 2.0}) {
    SCOPED_TRACE(mu_s);
    auto setting = setting_with(h, mu_s, 0, FrictionMethod::kConvex);
    setting.gravity = {0, -g, 0};
    setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({}, {1, 0, 0})};
    setting.planes[0].velocity = constant({-1, 0, 0});
    State state = no_particles(GetParam());
    add_particle(state, {1, 1, 0}, 1, 1);
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    for (int step = 1; step <= 5; ++step) {
      EXPECT_TRUE(simulation.step(1).has_given_loads);
      EXPECT_NEAR(spin(simulation.state()), -step * mu_s * g * h / inertia, 1e-9);
    }
  }
}

TEST_P(GivenLoadsOfSteps, AParticleThatMeetsABodyLateInAStepHasCoulombsFriction) {
  // The particle slides down an incline and meets a rigid body of two particles, which the first
  // rough solution does not contain. In a group with a body the loads of the first solution always
  // bound the friction of the second one. With the load that the particle had in the first rough
  // solution its spin would be wrong by 3 to 14 %.
  const auto spin_after = [](int dimension, FrictionMethod method, double mass, double distance) {
    auto setting = setting_with(0.1, 0.1, -0.01, method);
    const double half = 0.25 * std::numbers::sqrt2;  // of the particle's centre along each axis
    setting.planes = {plane_at_rest({}, {2 * half, 2 * half, 0})};
    State state = no_particles(dimension);
    add_particle(state, {half, half, 0}, 0.5, 1, {0, -1, 0});
    for (const double x : {1.0, 2.0})
      add_particle(state, {half + x + distance, half, 0}, 0.5, mass);
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{1, 2}});
    Simulation simulation(setting, state, 1);
    EXPECT_TRUE(simulation.step(1).converged);
    return spin(simulation.state());
  };
  for (const double mass : {1.0, 5.0})
    for (const double distance : {0.02, 0.03}) {
      const auto of = [&](FrictionMethod method) {
        return spin_after(GetParam(), method, mass, distance);
      };
      const double expected = of(FrictionMethod::kFixedPoint);
      // The loads of the first of two solutions are those of the second one but for 1e-3.
      EXPECT_NEAR(of(FrictionMethod::kConvex), expected, 2e-3 * std::abs(expected));
    }
}

}  // namespace
}  // namespace viscontact::particles
