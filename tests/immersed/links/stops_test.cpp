// Stops of hinges, docs/physics.md (5.12) and (6.4): the angle at which they end a motion and the
// torque with which they hold, without a fluid and in one, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

constexpr double kTolerance = 1e-10;  // of the solvers, in mean radii

/// A disc of radius 0.1 and mass 1 on a hinge in its middle, at the angle 0.
Hinge hinge_of_disc(const Vector& at, double lowest, double highest) {
  Hinge hinge;
  hinge.at = at;
  hinge.lowest_angle = lowest;
  hinge.highest_angle = highest;
  return hinge;
}

/// A body of two discs of mass 1 at the distances 0 and 1 from a hinge, which falls under gravity
/// 1.
void add_falling_body(State& state, Setting& setting, const Vector& at, double lowest) {
  setting.gravity = {0, -1, 0};
  add_particle(state, at, 0.1, 1);
  add_particle(state, at + Vector{1, 0, 0}, 0.1, 1);
  auto& p = state.particles;
  add_rotation(p);
  add_rigid_body(p, {{0, 1}});
  auto hinge = hinge_of_disc(at, lowest, std::numeric_limits<double>::infinity());
  hinge.body = 0;
  hinge.point = {0, at - p.bodies.bodies[0].centre};
  setting.links.hinges = {hinge};
  setting.solver.tolerance = kTolerance;
}

/// Largest error of the angle of a stop of a body whose particles have this mean radius [rad]: the
/// tolerance of a gap at the lever of the radius, 0.1.
constexpr double kAngle = kTolerance;

TEST(Stops, ABodyFallsOnAStopAndRestsOnIt) {
  State state = no_particles(2);
  Setting setting;
  setting.time_step = 0.01;
  add_falling_body(state, setting, {}, -0.3);
  Simulation simulation(setting, state, 1);
  // A landing takes two steps.
  int landed = 0;
  run(simulation, 2, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time;
    const auto& body = simulation.state().particles.bodies.bodies[0];
    EXPECT_GE(body.angle[2], -0.3 - kAngle) << report.time;
    // The weight of the outer disc acts at the distance cos(0.3).
    if (landed > 1) {
      EXPECT_NEAR(body.angle[2], -0.3, kAngle) << report.time;
      EXPECT_NEAR(simulation.state().link_forces[2], std::cos(0.3), 1e-6) << report.time;
      EXPECT_NEAR(body.angular_velocity[2], 0, 1e-6) << report.time;
    }
    if (body.angle[2] <= -0.3 + kAngle) ++landed;
  });
  EXPECT_GT(landed, 100);
}

// Each of two stops takes the whole impact, whatever the time step, and torques push from one to
// the other.
TEST(Stops, ADiscGoesToAndFroBetweenItsStops) {
  for (const double h : {0.3, 0.01}) {
    State state = no_particles(2);
    add_particle(state, {}, 0.1, 1);
    add_rotation(state.particles);
    Setting setting;
    setting.time_step = h;
    setting.solver.tolerance = kTolerance;
    setting.links.hinges = {hinge_of_disc({}, -0.5, 0.25)};
    setting.torques[0].pieces = {{3, {0, 0, 1}}, {1e300, {0, 0, -2}}};
    Simulation simulation(setting, state, 1);
    run(simulation, 3, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    EXPECT_NEAR(simulation.state().particles.angles[0], 0.25, kAngle);
    EXPECT_NEAR(simulation.state().link_forces[2], -1, 1e-6);
    run(simulation, 6, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    EXPECT_NEAR(simulation.state().particles.angles[0], -0.5, kAngle);
    EXPECT_NEAR(simulation.state().link_forces[2], 2, 1e-6);
  }
}

// A torsion spring that is relaxed beyond the stop presses on it; the torque of the hinge is that
// of both.
TEST(Stops, ASpringPressesOnAStop) {
  State state = no_particles(2);
  add_particle(state, {}, 0.1, 1);
  add_rotation(state.particles);
  Setting setting;
  setting.time_step = 0.1;
  setting.solver.tolerance = kTolerance;
  auto hinge = hinge_of_disc({}, -1, 0.2);
  hinge.stiffness = 3;
  hinge.rest_angle = 1.2;
  setting.links.hinges = {hinge};
  Simulation simulation(setting, state, 1);
  run(simulation, 4, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
  EXPECT_NEAR(simulation.state().particles.angles[0], 0.2, kAngle);
  EXPECT_NEAR(simulation.state().link_forces[2], 0, 1e-6);
}

class StopsInFluid : public ::testing::TestWithParam<double> {};  // density of the fluid
INSTANTIATE_TEST_SUITE_P(Densities, StopsInFluid, ::testing::Values(0.0, 1e-12));

TEST_P(StopsInFluid, ABodyLandsExactlyAndRestsThereUntilItIsLifted) {
  auto system = in_fluid(2, 100, 0.02, 0.01);
  system.setting.fluid->density = GetParam();
  add_falling_body(system.state, system.setting, {50, 50, 0}, -0.3);
  // From t = 3 on a torque lifts the body, which needs more than the weight at the distance.
  system.setting.torques[1].pieces = {{3, {}}, {1e300, {0, 0, 1.2}}};
  auto simulation = system.simulation(constant_drag(0.3));
  bool has_landed = false;
  double torque = 0;
  while (simulation.state().time < 3.5 - 0.01) {
    const auto report = simulation.step(3.5);
    EXPECT_TRUE(report.converged) << report.time;
    const auto& body = simulation.state().particles.bodies.bodies[0];
    EXPECT_GE(body.angle[2], -0.3 - kAngle) << report.time;
    if (has_landed && report.time < 3) {
      EXPECT_NEAR(body.angle[2], -0.3, kAngle) << report.time;
      torque = simulation.state().link_forces[2];
    }
    has_landed = has_landed || body.angle[2] <= -0.3 + kAngle;
  }
  EXPECT_TRUE(has_landed);
  EXPECT_NEAR(torque, std::cos(0.3), 1e-6);
  EXPECT_GT(simulation.state().particles.bodies.bodies[0].angle[2], -0.3 + 1e-3);
}

// The angle of a single particle is its own, also where a stop turns it back through a spring.
TEST_P(StopsInFluid, ADiscIsHeldAtItsHighestAngle) {
  auto system = in_fluid(2, 100, 0.05, 0.01);
  system.setting.fluid->density = GetParam();
  add_disc(system, {50, 50, 0}, 1, {});
  system.state.particles.angular_velocities[0] = 2;
  auto hinge = hinge_of_disc({50, 50, 0}, -1, 0.1);
  hinge.stiffness = 0.05;
  hinge.rest_angle = 0.5;
  system.setting.links.hinges = {hinge};
  system.setting.solver.tolerance = kTolerance;
  auto simulation = system.simulation(constant_drag(0.01));
  run(simulation, 2);
  EXPECT_NEAR(simulation.state().particles.angles[0], 0.1, kAngle);
  EXPECT_NEAR(simulation.state().link_forces[2], 0, 1e-6);
}

}  // namespace
}  // namespace viscontact::particles
