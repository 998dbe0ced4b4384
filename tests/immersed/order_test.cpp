// Away from contact, a step in a fluid is of second order in h: with and without mass, with drag
// that depends on the place, and where forces jump within a step.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// Drag of a sphere on the axis that depends on its height z.
Resistance drag_at(std::function<double(double)> drag) {
  return [drag](const Particles& p) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Constant(1, 1, drag(p.positions[0]));
  };
}

struct Motion {
  double z, velocity;
};

/// The sphere at `end`, with steps of length h.
Motion simulated(const std::function<double(double)>& drag, double mass,
                 const PiecewiseConstant& force, double h, double end) {
  auto system = in_fluid(1, 100, h, 0.01);
  add_particle(system.state, {20, 0, 0}, 1, mass, {0, 0, 0});
  system.setting.forces[0] = force;
  auto simulation = system.simulation(drag_at(drag));
  run(simulation, end);
  const auto& p = simulation.state().particles;
  return {p.positions[0], p.velocities[0]};
}

/// The error falls with h^2 over steps from h to h/8. Errors of two kinds may cancel at one h, so
/// that it may fall faster from there.
void expect_second_order(const std::function<double(double h)>& value, double exact, double h) {
  const double coarse = std::abs(value(h) - exact), fine = std::abs(value(h / 8) - exact);
  EXPECT_GT(fine, 1e-12) << "rounding errors hide the order";
  EXPECT_GT(std::log(coarse / fine) / std::log(8), 1.85) << coarse << " " << fine;
}

PiecewiseConstant pieces(std::vector<PiecewiseConstant::Piece> list) { return {std::move(list)}; }

TEST(FluidOrder, ConstantDragWithoutMassIsExactWithAnyStepAndJump) {
  // The force jumps within steps. z = 20 + integral of the force over the drag.
  const auto force = pieces({{0.377, {-3, 0, 0}}, {1e9, {2, 0, 0}}});
  const auto constant = [](double) { return 5.0; };
  for (const double h : {0.3, 0.1, 0.013})
    EXPECT_NEAR(simulated(constant, 0, force, h, 1).z, 20 + (-3 * 0.377 + 2 * 0.623) / 5, 1e-13);
}

TEST(FluidOrder, DragThatGrowsWithThePlaceWithoutMass) {
  // R = k z, so that k z^2/2 = k z0^2/2 + integral of the force.
  const double k = 0.5;
  const auto drag = [k](double z) { return k * z; };
  const auto steady = pieces({{1e9, {-20, 0, 0}}});
  expect_second_order([&](double h) { return simulated(drag, 0, steady, h, 1).z; },
                      std::sqrt(400 - 2 / k * 20), 0.1);
  const auto jumping = pieces({{0.377, {-50, 0, 0}}, {1e9, {30, 0, 0}}});
  const double impulse = -50 * 0.377 + 30 * 0.623;
  const double exact = std::sqrt(400 + 2 / k * impulse);
  // The place of the jump in its step changes with h, and the constant of the error with it.
  const auto error = [&](double h) {
    return std::abs(simulated(drag, 0, jumping, h, 1).z - exact);
  };
  EXPECT_LT(error(0.01), error(0.1) / 40);
  EXPECT_LT(error(0.001), error(0.01) / 40);
}

TEST(FluidOrder, ConstantDragWithMass) {
  // m u' = f - R u from rest.
  const double mass = 2, drag = 5, f = -7, end = 0.5;
  const double u = f / drag * (1 - std::exp(-drag / mass * end));
  const double z = 20 + f / drag * end - mass / drag * u;
  const auto constant = [drag](double) { return drag; };
  const auto steady = pieces({{1e9, {f, 0, 0}}});
  expect_second_order([&](double h) { return simulated(constant, mass, steady, h, end).z; }, z,
                      0.01);
  expect_second_order([&](double h) { return simulated(constant, mass, steady, h, end).velocity; },
                      u, 0.01);
}

/// (4.1) with R = k/z and this force, by the classical method of Runge and Kutta with tiny steps
/// that end at the jumps.
Motion exact_with_drag(const std::function<double(double)>& drag, double mass,
                       const PiecewiseConstant& force, double end) {
  double z = 20, u = 0, t = 0;
  for (const auto& piece : force.pieces) {
    const double until = std::min(piece.until, end);
    constexpr int kSteps = 4000;
    const double h = (until - t) / kSteps;
    const auto acceleration = [&](double at, double with) {
      return (piece.value[0] - drag(at) * with) / mass;
    };
    for (int step = 0; step < kSteps && h > 0; ++step) {
      const double a1 = acceleration(z, u), u2 = u + h / 2 * a1;
      const double a2 = acceleration(z + h / 2 * u, u2), u3 = u + h / 2 * a2;
      const double a3 = acceleration(z + h / 2 * u2, u3), u4 = u + h * a3;
      const double a4 = acceleration(z + h * u3, u4);
      z += h / 6 * (u + 2 * u2 + 2 * u3 + u4);
      u += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    t = until;
  }
  return {z, u};
}

TEST(FluidOrder, DragThatDependsOnThePlaceWithMass) {
  const auto drag = [](double z) { return 3000 / (z * z); };
  const auto steady = pieces({{1e9, {-40, 0, 0}}});
  for (const double mass : {0.1, 1.0, 10.0}) {
    SCOPED_TRACE(mass);
    const auto exact = exact_with_drag(drag, mass, steady, 1);
    // A mass that the drag stops fast needs steps that resolve the start.
    const double h = mass < 1 ? 0.0025 : 0.01;
    expect_second_order([&](double step) { return simulated(drag, mass, steady, step, 1).z; },
                        exact.z, h);
    expect_second_order(
        [&](double step) { return simulated(drag, mass, steady, step, 1).velocity; },
        exact.velocity, h);
  }
}

TEST(FluidOrder, JumpsOfTheForceWithinAStepWithMass) {
  const auto drag = [](double z) { return 3000 / (z * z); };
  const auto jumping = pieces({{0.377, {-60, 0, 0}}, {1e9, {30, 0, 0}}});
  const auto exact = exact_with_drag(drag, 2, jumping, 1);
  const auto error = [&](double h) {
    const auto end = simulated(drag, 2, jumping, h, 1);
    return std::max(std::abs(end.z - exact.z), std::abs(end.velocity - exact.velocity));
  };
  EXPECT_LT(error(0.01), error(0.1) / 40);
  EXPECT_LT(error(0.001), error(0.01) / 40);
}

TEST(FluidOrder, ASmallMassDoesNotOscillate) {
  // The drag is 1e6 times the mass over the step: the velocity is that without mass from the first
  // step on.
  const auto drag = [](double) { return 1000.0; };
  const auto steady = pieces({{1e9, {-10, 0, 0}}});
  for (const double end : {0.1, 0.2, 0.3})
    EXPECT_NEAR(simulated(drag, 1e-4, steady, 0.1, end).velocity, -0.01, 1e-5);
}

// Near a wall the drag is many times the Stokes drag, 6 pi here.
TEST(FluidOrder, StrongDragDoesNotReverseAVelocity) {
  constexpr double kStokes = 18.849555921538759;
  for (const double times : {10.0, 100.0, 300.0})
    for (const double z : {0.01, 0.1, 1.0, 3.0}) {
      const double h = 0.1, mass = h * kStokes / z;
      auto system = in_fluid(1, 100, h, 0.01);
      add_particle(system.state, {20, 0, 0}, 1, mass, {-1, 0, 0});
      auto simulation = system.simulation(drag_at([&](double) { return times * kStokes; }));
      double before = -1;
      for (int step = 1; step <= 10; ++step) {
        run(simulation, step * h);
        const double velocity = simulation.state().particles.velocities[0];
        EXPECT_LE(velocity, 0) << times << " " << z << " " << step;
        EXPECT_GT(velocity, before) << times << " " << z << " " << step;
        before = velocity;
      }
    }
}

}  // namespace
}  // namespace viscontact::particles
