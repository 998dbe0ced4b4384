// Rigid bodies, hinges, springs and arms of particles in a fluid with a given resistance, against
// closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/immersed/links/constrained_solver.hpp"

namespace viscontact::particles {
namespace {

/// A body of three particles in the plane, of drag 2 each without inertia, with `force` on the
/// last.
InFluid body_in_fluid(double h, double mass, const Vector& force) {
  auto system = in_fluid(2, 100, h, 0.01);
  for (const Vector& at : {Vector{49, 50, 0}, Vector{51, 50, 0}, Vector{50, 53, 0}})
    add_pushed(system, at, 0.5, mass, {});
  system.setting.forces[2] = constant(force);
  auto& p = system.state.particles;
  p.angles.assign(3, 0);
  p.angular_velocities.assign(3, 0);
  p.inertias.assign(3, round_shape(2, 0.5).inertia(mass));
  add_rigid_body(p, {{0, 1, 2}});
  return system;
}

TEST(ConstrainedInFluid, ABodyMovesAsOneRigidParticle) {
  auto system = body_in_fluid(0.01, 0, {3, 0, 0});
  auto simulation = system.simulation(constant_drag(2));
  run(simulation, 0.01);
  const auto& p = simulation.state().particles;
  const auto& body = p.bodies.bodies[0];
  // Its resistance is 3 times 2, and to turning 3 times 2 and 2 |r|^2 of each particle about the
  // centre (50, 51), where the force at a height of 2 has the torque -6.
  EXPECT_NEAR(body.velocity[0], 3.0 / 6, 1e-12);
  EXPECT_NEAR(body.velocity[1], 0, 1e-12);
  EXPECT_NEAR(body.angular_velocity[2], -6.0 / (6 + 2 * (2 + 2 + 4)), 1e-12);
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(p.angular_velocities[k], body.angular_velocity[2], 1e-14);
}

TEST(ConstrainedInFluid, ABodyKeepsItsShapeToRoundOffAndMovesWithSecondOrder) {
  for (const double mass : {0.0, 1.5}) {
    SCOPED_TRACE(mass);
    std::vector<Vector> ends;
    for (const double h : {0.1, 0.05, 0.025, 0.00625}) {
      auto system = body_in_fluid(h, mass, {6, 0, 0});
      auto simulation = system.simulation(constant_drag(2));
      run(simulation, 4);
      const auto& p = simulation.state().particles;
      EXPECT_NEAR(norm(p.position(1) - p.position(0)), 2, 1e-13);
      EXPECT_NEAR(norm(p.position(2) - p.position(0)), std::sqrt(10), 1e-13);
      ends.push_back(p.position(2));
    }
    const double coarse = norm(ends[0] - ends[3]), middle = norm(ends[1] - ends[3]),
                 fine = norm(ends[2] - ends[3]);
    EXPECT_GT(coarse, 1e-4);
    EXPECT_GT(std::log2(coarse / middle), 1.8);
    EXPECT_GT(std::log2(middle / fine), 1.8);
  }
}

/// Two particles on an axis.
InFluid pair_on_axis(double h, double apart, double force) {
  auto system = in_fluid(1, 100, h, 0.01);
  add_pushed(system, {40, 0, 0}, 0.5, 0, {});
  add_pushed(system, {40 + apart, 0, 0}, 0.5, 0, {force, 0, 0});
  return system;
}

TEST(ConstrainedInFluid, ASpringRelaxesExponentiallyAndWithSecondOrder) {
  const double k = 3, drag = 2, rate = k * 2 / drag;
  std::vector<double> errors;
  for (const double h : {0.1, 0.05, 0.025}) {
    auto system = pair_on_axis(h, 4, 0);
    system.setting.links.springs = {{0, 1, k, 3}};
    auto simulation = system.simulation(constant_drag(drag));
    run(simulation, 1);
    const auto& p = simulation.state().particles;
    errors.push_back(p.positions[1] - p.positions[0] - 3 - std::exp(-rate));
  }
  EXPECT_LT(std::abs(errors[2]), 2e-4);
  EXPECT_GT(std::log2(std::abs(errors[0] / errors[1])), 1.8);
  EXPECT_GT(std::log2(std::abs(errors[1] / errors[2])), 1.8);
}

TEST(ConstrainedInFluid, AStiffSpringRelaxesWithoutOscillation) {
  auto system = pair_on_axis(0.1, 4, 0);
  system.setting.links.springs = {{0, 1, 1e8, 3}};
  auto simulation = system.simulation(constant_drag(2));
  run(simulation, 0.3);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.positions[1] - p.positions[0], 3, 1e-6);
}

TEST(ConstrainedInFluid, AnArmKeepsItsLengthAndItsForceBalancesTheDrag) {
  const double drag = 2;
  const SinusoidalLength length{4, 1, 2, 0};
  auto system = pair_on_axis(0.05, 4, 0);
  system.setting.links.arms = {{0, 1, length}};
  auto simulation = system.simulation(constant_drag(drag));
  for (double time = 0.05; time < 2; time += 0.05) {
    run(simulation, time);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(p.positions[1] - p.positions[0], length_at(length, simulation.state().time), 1e-12);
    EXPECT_NEAR(p.positions[1] + p.positions[0], 84, 1e-11);  // no force acts on both together
    const double h = 0.05, t = simulation.state().time;
    const double rate = (length_at(length, t) - length_at(length, t - h)) / h;
    EXPECT_NEAR(simulation.state().link_forces[0], drag * rate / 2, 1e-9);
  }
}

TEST(ConstrainedInFluid, ThePowerOfAnArmAddsUpToDissipationAndKineticEnergy) {
  // At rest at the start, then with kinks of the length at the times 0, 0.5 and 1.
  const double h = 0.01;
  for (const double mass : {0.0, 1e-3, 1.0, 30.0}) {
    SCOPED_TRACE(mass);
    auto system = in_fluid(1, 100, h, 0.01);
    add_pushed(system, {40, 0, 0}, 0.5, mass, {});
    add_pushed(system, {44, 0, 0}, 0.5, 2 * mass, {});
    system.setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 4}, {0.5, 3.5}, {1, 5}}}}};
    auto simulation = system.simulation(constant_drag(2));
    double work = 0, dissipated = 0;
    while (simulation.state().time < 1.5 - h / 2) {
      dissipated += h * simulation.step(1.5).fluid.dissipation;
      work += h * power_of_arm(system.setting, simulation.state());
      const auto& v = simulation.state().particles.velocities;
      // U^+, which moves the particles, differs from U by the second order of the step. Work at U
      // alone would be too large by 0.33 mass at the start.
      EXPECT_NEAR(work, dissipated + mass / 2 * v[0] * v[0] + mass * v[1] * v[1],
                  1e-3 * (1 + mass));
      // A kink causes no oscillation: the velocity is that of the length in each step but the one
      // in which the kink lies.
      const double t = simulation.state().time;
      EXPECT_NEAR(v[1] - v[0], t < 0.505 ? -1 : t < 1.005 ? 3 : 0, 0.01) << t;
    }
  }
}

TEST(ConstrainedInFluid, AHingedBodySwingsBackWithItsTorsionSpring) {
  const double stiffness = 4, drag = 2;
  auto system = body_in_fluid(0.02, 0, {});
  auto hinge = hinge_of_body(system.state.particles, {49, 50, 0});
  hinge.stiffness = stiffness;
  hinge.rest_angle = 0.4;
  system.setting.links.hinges = {hinge};
  auto simulation = system.simulation(constant_drag(drag));
  run(simulation, 3);
  const auto& p = simulation.state().particles;
  // The resistance to turning about the hinge: 3 times 2, and 2 |r|^2 with |r|^2 = 0, 4, 10.
  const double resistance = 6 + 2 * (4 + 10);
  EXPECT_NEAR(p.angles[0], 0.4 - 0.4 * std::exp(-stiffness / resistance * 3), 1e-5);
  EXPECT_NEAR(norm(p.position(0) - Vector{49, 50, 0}), 0, 1e-10);
}

TEST(ConstrainedInFluid, ErrorsOfForcesAreThoseOfTheirLinksOnTwoMeshes) {
  // On the second mesh the drag is 1 % larger, and with it the force of an arm; and the force of a
  // spring, -k (e + theta h rate) with the rate of the drag. The first solution and two corrections
  // leave over 0.01^3 of the force of 1, times 16/15.
  const double drag = 2, more = 1.01, h = 0.1, k = 3, e = 1, of_one_mesh = 16.0 / 15;
  for (const bool has_arm : {true, false}) {
    SCOPED_TRACE(has_arm);
    auto system = pair_on_axis(h, 4, 0);
    if (has_arm)
      system.setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 4}, {1, 5}}}}};
    else
      system.setting.links.springs = {{0, 1, k, 4 - e}};
    auto simulation = system.simulation(constant_drag(drag));
    system.fluid->drag_of_second_mesh = more;
    system.fluid->second_mesh = {of_one_mesh, 0.15, of_one_mesh};
    simulation.step(h);
    const auto spring = [&](double by) {
      const double z = h * k * 2 / drag, theta = (1 + z) / (2 + z);
      return -k * e / (1 + theta * h * k * 2 / by);
    };
    const double force = has_arm ? drag / 2 : spring(drag);
    const double second = has_arm ? drag * more / 2 : spring(drag * more);
    EXPECT_NEAR(simulation.state().link_forces[0], force, 1e-9);
    EXPECT_NEAR(simulation.force_errors().of_links.at(0), of_one_mesh * std::abs(second - force),
                2e-6);
    // The arm pushes the first particle back, and the fluid resists.
    EXPECT_NEAR(simulation.fluid_forces()[0], force + of_one_mesh * (second - force), 2e-6);
    EXPECT_NEAR(simulation.force_errors().of_fluid.at(0), 0.15 * std::abs(second - force), 1e-6);
  }
}

TEST(ConstrainedSolver, HasNoForcesOfRowsThatItNoLongerHolds) {
  auto system = in_fluid(1, 100, 0.1, 0.01);
  for (const double z : {40.0, 44.0}) add_pushed(system, {z, 0, 0}, 0.5, 0, {});
  const auto& p = system.state.particles;
  ConstrainedSolver solver(std::make_unique<StandInFluid>(constant_drag(2)), 1e-9, false);
  const VelocityConstraint rod{.entries = {{0, -1}, {1, 1}}};
  solver.hold({rod}, 0.1);
  solver.place({&p, {}, {}, {}});
  EXPECT_TRUE(solver.row_forces().empty());
  solver.velocities(std::vector{-3.0, 3.0}, true);
  ASSERT_EQ(solver.row_forces().size(), 1U);
  EXPECT_NEAR(solver.row_forces()[0], -3, 1e-9);
  solver.place({&p, {}, {}, {}});
  EXPECT_TRUE(solver.row_forces().empty());
  solver.velocities(std::vector{-3.0, 3.0}, true);
  solver.hold({}, 0.1);
  EXPECT_TRUE(solver.row_forces().empty());
  solver.place({&p, {}, {}, {}});
  solver.velocities(std::vector{-3.0, 3.0}, true);
  EXPECT_TRUE(solver.row_forces().empty());
  EXPECT_TRUE(solver.thetas().empty());
}

TEST(ConstrainedInFluid, ConstraintsThatContradictEachOtherAreNamed) {
  auto system = in_fluid(1, 100, 0.1, 0.01);
  for (const double z : {40.0, 44.0, 48.0}) add_pushed(system, {z, 0, 0}, 0.5, 0, {});
  system.setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 4}}}},
                               {1, 2, PiecewiseLinearLength{{{0, 4}}}},
                               {0, 2, PiecewiseLinearLength{{{0, 8}, {1, 9}}}}};
  auto simulation = system.simulation(constant_drag(2));
  try {
    run(simulation, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kNotConverged);
    EXPECT_NE(std::string(error.what()).find("arm 2 (particles 0 and 2)"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace viscontact::particles
