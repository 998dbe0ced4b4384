// Rigid bodies, hinges, springs and arms in a fluid with inertia, docs/physics.md (6.7), (6.9),
// whose flow a stand-in replaces by drag: orders, lengths that hold, and stiff springs.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// A fluid without weight, so that forces have no buoyancy.
InFluid with_inertia(int dimension, double h) {
  auto system = in_fluid(dimension, 100, h, 0.01);
  system.setting.fluid->density = 1e-12;
  return system;
}

/// The error of the value falls with h^2 from h to h/4.
void expect_order_2(const std::function<double(double h)>& value, double exact, double h) {
  const double coarse = std::abs(value(h) - exact), fine = std::abs(value(h / 4) - exact);
  EXPECT_GT(fine, 1e-10) << "rounding errors hide the order";
  EXPECT_GT(std::log(coarse / fine) / std::log(4), 1.8) << coarse << " " << fine;
}

constexpr double kDrag = 0.3;

// Two discs of mass 2 at the distance 2 as a body without forces: the centre moves straight on, and
// all rates decay by the drag.
TEST(ConstrainedInInertia, ABodyKeepsItsMomentaButForTheDrag) {
  constexpr double kEnd = 2, kSpin = 1.5;
  const auto at_end = [&](double h) {
    auto system = with_inertia(2, h);
    add_disc(system, {49, 50, 0}, 2, {3, -kSpin, 0});
    add_disc(system, {51, 50, 0}, 2, {3, kSpin, 0});
    auto& p = system.state.particles;
    p.angular_velocities.assign(2, kSpin);
    add_rigid_body(p, {{0, 1}});
    auto simulation = system.simulation(constant_drag(kDrag));
    run(simulation, kEnd);
    const auto& moved = simulation.state().particles;
    EXPECT_NEAR(norm(moved.position(1) - moved.position(0)), 2, 1e-12);
    EXPECT_EQ(moved.angular_velocities[0], moved.angular_velocities[1]);
    return moved.bodies.bodies[0];
  };
  const double inertia = 2 * (2 + round_shape(2, 0.1).inertia(2));
  const double rate = kDrag / 2, of_spin = kDrag * 4 / inertia;
  expect_order_2([&](double h) { return at_end(h).velocity[0]; }, 3 * std::exp(-rate * kEnd), 0.1);
  expect_order_2([&](double h) { return at_end(h).angular_velocity[2]; },
                 kSpin * std::exp(-of_spin * kEnd), 0.1);
  expect_order_2([&](double h) { return at_end(h).angle[2]; },
                 kSpin * (1 - std::exp(-of_spin * kEnd)) / of_spin, 0.1);
  EXPECT_NEAR(at_end(0.1).centre[1], 50, 1e-12);
}

/// A body of two discs that swings on a hinge in the middle of one of them, under gravity 1.
struct Pendulum {
  double angle = 0, spin = 0;  ///< of the body at the end
  double energy = 0;           ///< largest magnitude; 0 at the start
};

/// Its moment of inertia about the hinge.
const double kAboutHinge = 1 + 2 * round_shape(2, 0.1).inertia(1);

Pendulum swinging(double h, double drag, double end) {
  auto system = with_inertia(2, h);
  system.setting.gravity = {0, -1, 0};
  add_disc(system, {50, 50, 0}, 1, {});
  add_disc(system, {51, 50, 0}, 1, {});
  auto& p = system.state.particles;
  add_rigid_body(p, {{0, 1}});
  const auto hinge = hinge_of_body(p, {50, 50, 0});
  system.setting.links.hinges = {hinge};
  auto simulation = system.simulation(constant_drag(drag));
  Pendulum result;
  while (simulation.state().time < end - h / 2) {
    EXPECT_TRUE(simulation.step(end).converged);
    const auto& now = simulation.state().particles;
    EXPECT_LT(norm(now.position(0) - hinge.at), 1e-7);
    const double spin = now.bodies.bodies[0].angular_velocity[2];
    const double energy = kAboutHinge * spin * spin / 2 + now.position(1)[1] - 50;
    result.energy = std::max(result.energy, std::abs(energy));
  }
  const auto& body = simulation.state().particles.bodies.bodies[0];
  result.angle = body.angle[2];
  result.spin = body.angular_velocity[2];
  return result;
}

TEST(ConstrainedInInertia, APendulumSwingsToSecondOrder) {
  // I w' = -cos(angle) - resistance w by Runge & Kutta's method of fourth order.
  constexpr double kEnd = 3;
  const double resistance = kDrag * (2 + 1);
  double angle = 0, spin = 0;
  constexpr int kSteps = 3000;
  const double dt = kEnd / kSteps;
  const auto rate = [&](double a, double w) {
    return (-std::cos(a) - resistance * w) / kAboutHinge;
  };
  for (int n = 0; n < kSteps; ++n) {
    const double k1 = rate(angle, spin), k2 = rate(angle + dt / 2 * spin, spin + dt / 2 * k1);
    const double k3 = rate(angle + dt / 2 * (spin + dt / 2 * k1), spin + dt / 2 * k2);
    const double k4 = rate(angle + dt * (spin + dt / 2 * k2), spin + dt * k3);
    angle += dt * spin + dt * dt / 6 * (k1 + k2 + k3);
    spin += dt / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  expect_order_2([&](double h) { return swinging(h, kDrag, kEnd).angle; }, angle, 0.05);
  expect_order_2([&](double h) { return swinging(h, kDrag, kEnd).spin; }, spin, 0.05);
  // Without drag the energy at the start, 0, is kept to the second order, over five swings.
  const double coarse = swinging(0.05, 1e-9, 40).energy, fine = swinging(0.025, 1e-9, 40).energy;
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, coarse / 3.3);
}

/// The place of the second of two spheres of mass 1 on an axis that a spring joins, which is
/// stretched by 1 at the start.
double oscillating(double h, double stiffness, double end) {
  auto system = with_inertia(1, h);
  add_particle(system.state, {40, 0, 0}, 1, 1);
  add_particle(system.state, {47, 0, 0}, 1, 1);
  system.setting.links.springs = {{0, 1, stiffness, 6}};
  auto simulation = system.simulation(constant_drag(1e-9));
  run(simulation, end);
  const auto& z = simulation.state().particles.positions;
  EXPECT_NEAR(z[0] + z[1], 87, 1e-9);  // nothing pushes the middle
  return z[1];
}

TEST(ConstrainedInInertia, SpringsOscillateToSecondOrderAndStiffOnesAreDamped) {
  // Both masses together oscillate with the square 2 k of the frequency.
  constexpr double kEnd = 3;
  expect_order_2([&](double h) { return oscillating(h, 2, kEnd); }, 46.5 + 0.5 * std::cos(2 * kEnd),
                 0.04);
  // 10^2 to 10^12 times too stiff for the step.
  for (const double stiffness : {1e4, 1e8, 1e14})
    EXPECT_NEAR(oscillating(0.1, stiffness, 6), 46.5, 1e-6) << stiffness;
}

TEST(ConstrainedInInertia, AnArmMovesSpheresByTheirMasses) {
  // The middle of mass stays where it is, because there is nearly no drag.
  const SinusoidalLength length{10, 2, 3, 0};
  const auto place = [&](double h) {
    auto system = with_inertia(1, h);
    add_particle(system.state, {40, 0, 0}, 1, 1);
    add_particle(system.state, {50, 0, 0}, 1, 3);
    system.setting.links.arms = {{0, 1, length}};
    auto simulation = system.simulation(constant_drag(1e-9));
    double time = 0;
    while (time < 2 - h / 2) {
      simulation.step(2);
      time = simulation.state().time;
      const auto& z = simulation.state().particles.positions;
      EXPECT_NEAR(z[1] - z[0], length_at(length, time), 1e-8);
    }
    // The force of an arm in a step is that at its beginning: the reduced mass 3/4 times the
    // acceleration.
    const double begin = time - h;
    EXPECT_NEAR(simulation.state().link_forces[0], -0.75 * 2 * 9 * std::sin(3 * begin), 60 * h * h);
    return simulation.state().particles.positions[0];
  };
  // The first rate of the arm begins at once and moves the sphere of mass 1 by three quarters.
  const double exact = 40 - 0.75 * 2 * std::sin(6.0);
  EXPECT_NEAR(place(0.02), exact, 1e-3);
  EXPECT_NEAR(place(0.005), exact, 1e-3 / 12);
}

}  // namespace
}  // namespace viscontact::particles
