// Particles with mass on arms, hinges and springs in a fluid with a given resistance: forces that
// turn with the motion, energies, and velocities that jump, against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::particles {
namespace {

constexpr double kTinyDrag = 1e-9;

ArmLength constant_length(double length) { return PiecewiseLinearLength{{{0, length}}}; }

/// What two discs of mass 1 do that circle about their middle at the distance 3 with the speed 1,
/// until the time 10.
struct Circling {
  double force_error = 0;   ///< largest difference from the centripetal force
  double energy_error = 0;  ///< of the last kinetic energy divided by the first one
};

/// They are held by an arm, or by a spring if its stiffness is > 0.
Circling circling(double h, double stiffness, double drag) {
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = drag;
  add_disc(system, {48.5, 50, 0}, 1, {0, -1, 0});
  add_disc(system, {51.5, 50, 0}, 1, {0, 1, 0});
  const double centripetal = 1 / 1.5;
  if (stiffness > 0)
    system.setting.links.springs = {{0, 1, stiffness, 3 - centripetal / stiffness}};
  else
    system.setting.links.arms = {{0, 1, constant_length(3)}};
  auto simulation = system.simulation(constant_drag(drag));
  Circling result;
  const double before = kinetic_energy(simulation.state().particles), end = 10;
  while (simulation.state().time < end - h / 2) {
    simulation.step(end);
    const double speed = std::exp(-drag * (simulation.state().time - h / 2));
    result.force_error = std::max(result.force_error, std::abs(simulation.state().link_forces[0] +
                                                               centripetal * speed * speed));
  }
  const double exact = std::exp(-2 * drag * end);
  result.energy_error = kinetic_energy(simulation.state().particles) / before - exact;
  return result;
}

TEST(LinkedMasses, CircleWithTheCentripetalForceAndTheirEnergy) {
  // An arm, a spring that is too stiff for the step, and one that the step resolves.
  for (const double stiffness : {0.0, 1e9, 1e2}) {
    SCOPED_TRACE(stiffness);
    const auto coarse = circling(0.04, stiffness, kTinyDrag);
    const auto fine = circling(0.02, stiffness, kTinyDrag);
    // The spring that is resolved begins to oscillate in the first step, which is implicit Euler.
    EXPECT_LT(coarse.force_error, stiffness == 1e2 ? 0.1 : 2e-4);
    EXPECT_LT(fine.force_error, coarse.force_error / 3.3);
    EXPECT_LT(std::abs(coarse.energy_error), stiffness == 1e2 ? 1e-3 : 1e-7);
  }
  const auto coarse = circling(0.025, 0, 0.05), fine = circling(0.0125, 0, 0.05);
  EXPECT_LT(std::abs(coarse.energy_error), 3e-6);
  // The drag in the force is that at the beginning of the step.
  EXPECT_LT(coarse.force_error, 5e-4);
  EXPECT_LT(fine.force_error, coarse.force_error / 1.8);
}

TEST(LinkedMasses, ADiscOnAHingeOffItsCentreIsHeldByTheCentripetalForce) {
  for (const double h : {0.1, 0.05, 0.01}) {
    auto system = in_fluid(2, 100, h, 0.01);
    system.setting.fluid->viscosity = kTinyDrag;
    const double arm = 0.4;
    add_disc(system, {50 + arm, 50, 0}, 1, {0, arm, 0});
    system.state.particles.angular_velocities[0] = 1;
    Hinge hinge;
    hinge.at = {50, 50, 0};
    hinge.point = {0, {-arm, 0, 0}};
    system.setting.links.hinges = {hinge};
    auto simulation = system.simulation(constant_drag(kTinyDrag));
    for (double time = h; time < 5; time += h) {
      simulation.step(10);
      const auto& f = simulation.state().link_forces;
      // The force points from the disc to the hinge.
      const double angle = simulation.state().particles.angles[0] - h / 2;
      EXPECT_NEAR(f[0], -arm * std::cos(angle), 0.02 * h) << simulation.state().time;
      EXPECT_NEAR(f[1], -arm * std::sin(angle), 0.02 * h) << simulation.state().time;
    }
    EXPECT_NEAR(simulation.state().particles.angular_velocities[0], 1, 0.1 * h * h);
  }
}

/// Two discs of mass 1 at the distance 1 as one body that turns about the first with the angular
/// velocity 1, on a hinge there.
InFluid hinged_pair(double h, double drag) {
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = drag;
  add_disc(system, {50, 50, 0}, 1, {});
  add_disc(system, {51, 50, 0}, 1, {0, 1, 0});
  auto& p = system.state.particles;
  p.angular_velocities.assign(2, 1);
  add_rigid_body(p, {{0, 1}});
  system.setting.links.hinges = {hinge_of_body(p, {50, 50, 0})};
  return system;
}

TEST(LinkedMasses, ABodyOnAHingeTurnsSteadilyAndIsHeldByTheCentripetalForce) {
  for (const double h : {0.1, 0.05}) {
    auto system = hinged_pair(h, kTinyDrag);
    auto simulation = system.simulation(constant_drag(kTinyDrag));
    run(simulation, 8);
    const auto& state = simulation.state();
    // 0.85 and 0.92 were seen where the inertia of the members acted at turned places.
    EXPECT_NEAR(state.particles.bodies.bodies[0].angular_velocity[2], 1, 0.1 * h * h);
    EXPECT_NEAR(std::hypot(state.link_forces[0], state.link_forces[1]), 1, 0.2 * h * h);
  }
}

TEST(LinkedMasses, ABodyOnAHingeSwingsUnderGravityAndDragToSecondOrder) {
  // I w' = -2 g 0.5 sin(angle) - resistance w, with the angle from below. The resistance of discs
  // of drag c: c 1^2 of the outer disc, and c of the turning of each.
  const double g = 3, drag = 0.3;
  const auto end = [&](double h) {
    auto system = hinged_pair(h, drag);
    system.setting.gravity = {0, -g, 0};
    auto simulation = system.simulation(constant_drag(drag));
    run(simulation, 4);
    return simulation.state().particles.bodies.bodies[0].angle[2];
  };
  const double inertia = 1 + 2 * round_shape(2, 0.1).inertia(1), resistance = 3 * drag;
  double angle = 0, w = 1;
  constexpr int kSteps = 40000;
  const double h = 4.0 / kSteps;
  const auto rate = [&](double at, double with) {
    return (-g * std::cos(at) - resistance * with) / inertia;
  };
  for (int n = 0; n < kSteps; ++n) {
    const double a1 = rate(angle, w), a2 = rate(angle + h / 2 * w, w + h / 2 * a1);
    angle += h * (w + h / 2 * a1);
    w += h * a2;
  }
  const double coarse = std::abs(end(0.01) - angle), fine = std::abs(end(0.0025) - angle);
  EXPECT_LT(coarse, 1e-5);
  EXPECT_GT(std::log2(coarse / fine) / 2, 1.85) << coarse << " " << fine;
}

TEST(LinkedMasses, KeepTheAngularMomentumAtAKinkOfAnArm) {
  // Forces along the arm have no torque about its middle: 2 is the angular momentum at all times.
  for (const double h : {0.1, 0.05}) {
    auto system = in_fluid(2, 100, h, 0.01);
    system.setting.fluid->viscosity = kTinyDrag;
    add_disc(system, {49, 50, 0}, 1, {0, -1, 0});
    add_disc(system, {51, 50, 0}, 1, {0, 1, 0});
    system.setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 2}, {0.5, 2}, {1, 3}}}}};
    auto simulation = system.simulation(constant_drag(kTinyDrag));
    run(simulation, 1);
    const auto& p = simulation.state().particles;
    const double momentum = cross(p.position(0) - Vector{50, 50, 0}, p.velocity(0))[2] +
                            cross(p.position(1) - Vector{50, 50, 0}, p.velocity(1))[2];
    EXPECT_NEAR(momentum, 2, h * h) << h;
  }
}

TEST(LinkedMasses, ThatCannotHoldAreAnErrorThatSaysSo) {
  // A disc between a fixed one and one that is driven away by more than both arms reach.
  auto system = in_fluid(2, 100, 0.01, 0.01);
  for (const double x : {50.0, 50.9, 51.8})
    add_disc(system, {x, x == 50.9 ? 50.436 : 50, 0}, 1, {});
  system.setting.given_motions[0] = {};
  system.setting.given_motions[2] = {{{{100, {0.25, 0, 0}}}}, {}};
  system.setting.links.arms = {{0, 1, constant_length(1)}, {1, 2, constant_length(1)}};
  auto simulation = system.simulation(constant_drag(1));
  try {
    run(simulation, 1);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kNotConverged);
    EXPECT_NE(std::string(error.what()).find("links"), std::string::npos) << error.what();
  }
}

/// Three discs that turn, with arms of changing lengths between all of them. Returns work of the
/// arms minus dissipation minus kinetic energy won, divided by the sum of their amounts, at time 4.
double imbalance(double h, double drag, double mass, bool has_kinks) {
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = drag;
  add_disc(system, {48, 50, 0}, mass, {0, -1, 0});
  add_disc(system, {52, 50, 0}, 2 * mass, {0, 0.5, 0});
  add_disc(system, {50, 53, 0}, 3 * mass, {0.2, 0, 0});
  const auto length = [&](double mean, double frequency) -> ArmLength {
    if (has_kinks)
      return PiecewiseLinearLength{{{0, mean}, {1.23, mean + 1 / frequency}, {3.1, mean}}};
    return SinusoidalLength{mean, 0.5, frequency, 0};
  };
  const double side = std::sqrt(13);
  system.setting.links.arms = {
      {0, 1, length(4, 2)}, {1, 2, length(side, 3)}, {0, 2, length(side, 1.5)}};
  auto simulation = system.simulation(constant_drag(drag));
  const double before = kinetic_energy(simulation.state().particles);
  double work = 0, dissipated = 0;
  while (simulation.state().time < 4 - h / 2) {
    dissipated += h * simulation.step(4).fluid.dissipation;
    for (const double power : simulation.state().arm_powers) work += h * power;
  }
  const double won = kinetic_energy(simulation.state().particles) - before;
  return (work - dissipated - won) / (std::abs(work) + dissipated + std::abs(won));
}

TEST(LinkedMasses, TheWorkOfTheirArmsIsDissipatedOrBecomesKineticEnergy) {
  for (const bool has_kinks : {false, true})
    for (const double mass : {0.01, 1.0}) {
      SCOPED_TRACE(mass);
      // Without drag, the momentum of each step has the work of its forces.
      EXPECT_NEAR(imbalance(0.04, kTinyDrag, mass, has_kinks), 0, 1e-9);
      // The drag is that at the beginning of the step: first order in h. 0.2 was seen where forces
      // lacked what turns the velocities.
      for (const double drag : {0.1, 2.0})
        EXPECT_NEAR(imbalance(0.01, drag, mass, has_kinks), 0, 5e-4) << drag;
    }
}

/// The forces at the times 0.5, 1 and 1.5 of two arms, between the first and the second and between
/// the second and the third of three discs with these masses, whose drag depends on their places.
std::vector<double> forces_of_arms(double h, const std::array<double, 3>& masses) {
  auto system = in_fluid(2, 100, h, 0.01);
  system.setting.fluid->viscosity = 2;
  add_disc(system, {48, 50, 0}, masses[0], {0, 0, 0});
  add_disc(system, {52, 50, 0}, masses[1], {0, 0, 0});
  add_disc(system, {50, 53, 0}, masses[2], {0, 0, 0});
  system.setting.forces[0] = constant({0, 4, 0});
  system.setting.forces[2] = constant({2, 1, 0});
  system.setting.links.arms = {{0, 1, SinusoidalLength{4, 0.5, 2, 0}},
                               {1, 2, SinusoidalLength{std::sqrt(13), 0.5, 3, 0}}};
  auto simulation = system.simulation([](const Particles& p) -> Eigen::MatrixXd {
    Eigen::VectorXd drags(9);
    for (std::size_t k = 0; k < 3; ++k)
      drags.segment<3>(static_cast<Eigen::Index>(3 * k))
          .setConstant(2 + 0.3 * std::sin(p.position(k)[0] + 2 * p.position(k)[1]));
    return drags.asDiagonal();
  });
  std::vector<double> forces;
  for (const double end : {0.5, 1.0, 1.5}) {
    run(simulation, end);
    const auto& of_links = simulation.state().link_forces;
    forces.insert(forces.end(), of_links.begin(), of_links.end());
  }
  return forces;
}

TEST(LinkedMasses, OneSmallMassAmongParticlesWithoutMassChangesNoForceOfAnArm) {
  // A step with a small mass is implicit Euler, and one without masses of second order: forces
  // differ by about h times their rate, 1. Thirty times as much was seen in arms between
  // particles without mass.
  for (const double h : {0.05, 0.0125}) {
    const auto without = forces_of_arms(h, {0, 0, 0});
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> masses{};
      masses[k] = 1e-9;
      const auto with = forces_of_arms(h, masses);
      ASSERT_EQ(with.size(), 6U);
      for (std::size_t i = 0; i < with.size(); ++i) EXPECT_NEAR(with[i], without[i], 2 * h) << k;
    }
  }
}

TEST(LinkedMasses, ADumbbellThatLandsDoesNotBounce) {
  // Two spheres above each other fall with the speed 1 on the end of a cylinder: the film carries
  // their momentum, 2, and their weight from then on. An arm or a stiff spring holds them.
  const double weight = 0.5, end = 3;
  for (const double h : {0.1, 0.03, 0.01})
    for (const double stiffness : {0.0, 1e9}) {
      SCOPED_TRACE(h);
      SCOPED_TRACE(stiffness);
      auto system = in_fluid(1, 100, h, 0.01);
      system.setting.fluid->viscosity = kTinyDrag;
      for (const double z : {2.0, 5.0}) {
        add_pushed(system, {z, 0, 0}, 1, 1, {-weight, 0, 0});
        system.state.particles.velocities.back() = -1;
      }
      if (stiffness > 0)
        system.setting.links.springs = {{0, 1, stiffness, 3}};
      else
        system.setting.links.arms = {{0, 1, constant_length(3)}};
      auto simulation = system.simulation(constant_drag(kTinyDrag));
      double largest = -1;
      while (simulation.state().time < end - h / 2) {
        simulation.step(end);
        for (const double v : simulation.state().particles.velocities)
          largest = std::max(largest, v);
      }
      // The spring, pressed together by the momentum 1 in one step, pushes back in the next ones.
      EXPECT_LT(largest, stiffness > 0 ? 2 / (stiffness * h * h) : 1e-12);
      EXPECT_NEAR(simulation.state().walls.at(0).gamma, -(2 + 2 * weight * end), 1e-6);
    }
}

TEST(LinkedMasses, FollowADrivenSphereWhoseVelocityJumps) {
  // An arm, a chain of two arms, or a stiff spring to a sphere that moves with the velocity 1 from
  // the time 0.5 on: the last sphere does, too, from the step with the jump on.
  const double h = 0.1;
  for (const double jump : {0.5, 0.53})
    for (const double stiffness : {0.0, 1e9}) {
      SCOPED_TRACE(stiffness);
      auto system = in_fluid(1, 100, h, 0.01);
      system.setting.fluid->viscosity = kTinyDrag;
      for (const double z : {10.0, 13.0, 16.0}) add_particle(system.state, {z, 0, 0}, 1, 1);
      system.setting.given_motions[0] = {{{{jump, {}}, {100, {1, 0, 0}}}}, {}};
      if (stiffness > 0)
        system.setting.links.springs = {{0, 1, stiffness, 3}, {1, 2, stiffness, 3}};
      else
        system.setting.links.arms = {{0, 1, constant_length(3)}, {1, 2, constant_length(3)}};
      auto simulation = system.simulation(constant_drag(kTinyDrag));
      while (simulation.state().time < 2 - h / 2) {
        simulation.step(2);
        const auto& state = simulation.state();
        const double given = std::clamp((state.time - jump) / h, 0.0, 1.0);
        EXPECT_NEAR(state.particles.velocities[2], given, 1e-5) << state.time;
      }
      EXPECT_NEAR(simulation.state().particles.positions[2], 16 + 2 - jump, 1e-6);
      EXPECT_NEAR(simulation.state().link_forces[1], 0, 1e-6);
    }
}

}  // namespace
}  // namespace viscontact::particles
