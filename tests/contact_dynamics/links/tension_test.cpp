// Particles between links and films under tension, in steps up to a period of their fastest motion.
#include "viscontact/constraint_rows/tension.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 9.81, kLength = 1.5, kHeavy = 100, kVelocity = 0.01;

struct Units {
  double mass = 1, length = 1, time = 1;
  double angle = 0;  // by which the scene is turned [rad]
};

enum class Link { kArm, kSpring };

/// Masses 1, 1 and 100 below each other, the first on a hinge, the middle one with a velocity.
Simulation double_pendulum(int dimension, Scheme scheme, Link link, double h,
                           std::optional<FrictionMethod> method = {}, const Units& units = {}) {
  const Vector down{std::sin(units.angle), -std::cos(units.angle), 0},
      aside{std::cos(units.angle), std::sin(units.angle), 0};
  const double force = units.mass * units.length / (units.time * units.time);
  Setting setting;
  setting.time_step = h * units.time;
  setting.scheme = scheme;
  setting.gravity = (kGravity * units.length / (units.time * units.time)) * down;
  if (method) {
    setting.laws.film.gamma_min = 0;
    setting.laws.friction = FrictionLaw{.coefficient = 0.3, .method = *method};
  }
  State state = no_particles(dimension);
  for (int k = 0; k < 3; ++k)
    add_particle(state, (k * kLength * units.length) * down, 0.1 * units.length,
                 units.mass * (k == 2 ? kHeavy : 1),
                 (k == 1 ? kVelocity * units.length / units.time : 0) * aside);
  add_rotation(state.particles);
  setting.links.hinges.emplace_back();
  for (std::int32_t k = 0; k < 2; ++k) {
    const double rest = kLength - (kHeavy + 1 - k) * kGravity / 1e5;
    if (link == Link::kArm)
      setting.links.arms.push_back(
          {k, k + 1, PiecewiseLinearLength{{{0, kLength * units.length}}}});
    else
      setting.links.springs.push_back({k, k + 1, 1e5 * force / units.length, rest * units.length});
  }
  return {setting, state, 1};
}

/// The modes across of the double pendulum: squares of angular frequencies, shares of the middle.
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> modes() {
  const double upper = (kHeavy + 1) * kGravity / kLength, lower = kHeavy * kGravity / kLength;
  Eigen::Matrix2d stiffness, mass;
  stiffness << upper + lower, -lower, -lower, lower;
  mass << 1, 0, 0, kHeavy;
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(stiffness, mass);
}

/// x of the middle disc after n steps of Newmark's rule with beta = 1/2, if it is `first` after one
/// step. The slow mode has the amplitude of an exact motion.
double by_newmark(double h, int n, double first) {
  const auto of = modes();
  std::array<double, 2> phases{}, amplitudes{};
  for (int k = 0; k < 2; ++k) {
    const double w = std::sqrt(of.eigenvalues()[k]), share = of.eigenvectors()(0, k);
    phases[index_of(k)] = std::acos(1 / (1 + h * h * w * w / 2));
    amplitudes[index_of(k)] = share * share * kVelocity / w;
  }
  amplitudes[1] = (first - amplitudes[0] * std::sin(phases[0])) / std::sin(phases[1]);
  return amplitudes[0] * std::sin(n * phases[0]) + amplitudes[1] * std::sin(n * phases[1]);
}

class Tension : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Tension, ::testing::Values(2, 3));

TEST_P(Tension, OfADoublePendulumDoesNotGrowAtAnyStep) {
  const double period = 2 * kPi / std::sqrt(modes().eigenvalues()[1]);
  constexpr double exact = 2.885e-4;  // the sum of the amplitudes of both modes
  for (const double part : {1e-3, 0.03, 0.05, 0.1, 0.32, 0.5, 1.0})
    for (const auto link : {Link::kArm, Link::kSpring})
      for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler}) {
        auto simulation = double_pendulum(GetParam(), scheme, link, part * period);
        double early = 0, late = 0;
        for (int n = 0; n < 400; ++n) {
          EXPECT_TRUE(simulation.step(1e9).converged);
          auto& largest = n < 200 ? early : late;
          largest = std::max(largest, std::abs(simulation.state().particles.position(1)[0]));
        }
        // Steps of 5 % of a period, where one of the links is a spring across and the other is not,
        // have amplitudes that are 2.3 % too large.
        EXPECT_LT(std::max(early, late), 1.025 * exact) << part;
        // With Euler velocities at the start count as those half a step before. A start that a step
        // does not resolve has a smaller amplitude: with kappa = (w h)^2 it is multiplied by
        // (1 + kappa/2)/((1 + 3 kappa/8) (1 + kappa/4)^(1/2)), 0.4 at a period. 400 of the shortest
        // steps are less than a period.
        const double kappa = std::pow(2 * kPi * part, 2);
        const double start = (1 + kappa / 2) / ((1 + 3 * kappa / 8) * std::sqrt(1 + kappa / 4));
        const double least = part > 0.01 ? (scheme == Scheme::kEuler ? 0.5 : 0.95) * start : 0;
        EXPECT_GT(late, least * exact) << part;
      }
}

TEST_P(Tension, OfADoublePendulumMovesAsNewmarksRuleDoes) {
  const double period = 2 * kPi / std::sqrt(modes().eigenvalues()[1]);
  for (const double part : {0.1, 0.3, 1.0})
    for (const auto link : {Link::kArm, Link::kSpring}) {
      const double h = part * period;
      auto simulation = double_pendulum(GetParam(), Scheme::kLeapfrog, link, h);
      double first = 0;
      for (int n = 1; n <= 50; ++n) {
        simulation.step(1e9);
        const double x = simulation.state().particles.position(1)[0];
        if (n == 1) first = x;
        // 2e-3 of the amplitude, half of it for the first step: the stretched springs change T/l by
        // 1e-2/1.5 at most.
        EXPECT_NEAR(x, by_newmark(h, n, first), link == Link::kArm ? 6e-7 : 3e-6)
            << part << " " << n;
      }
    }
}

TEST_P(Tension, IsTheSameWithFrictionInOtherUnitsAndTurned) {
  const double h = 0.09;
  for (const auto link : {Link::kArm, Link::kSpring}) {
    auto reference = double_pendulum(GetParam(), Scheme::kLeapfrog, link, h);
    for (int n = 0; n < 60; ++n) reference.step(1e9);
    const double x = reference.state().particles.position(1)[0];
    const auto expect_same = [&](Simulation simulation, const Units& units) {
      for (int n = 0; n < 60; ++n) EXPECT_TRUE(simulation.step(1e99).converged);
      const Vector at = simulation.state().particles.position(1);
      // Lengths are exact to 1e-6 of a radius.
      EXPECT_NEAR((std::cos(units.angle) * at[0] + std::sin(units.angle) * at[1]) / units.length, x,
                  1e-9);
    };
    for (const Units& units :
         {Units{1e5, 1e-5, 1e-5}, Units{1e-8, 1e-2, 1e3, 0}, Units{1, 1, 1, 2}})
      expect_same(double_pendulum(GetParam(), Scheme::kLeapfrog, link, h, {}, units), units);
    for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex})
      expect_same(double_pendulum(GetParam(), Scheme::kLeapfrog, link, h, method), {});
  }
}

TEST_P(Tension, RunsOnFromAStateWithTheSameBits) {
  auto whole = double_pendulum(GetParam(), Scheme::kLeapfrog, Link::kArm, 0.1);
  for (int n = 0; n < 10; ++n) whole.step(1e9);
  Simulation continued(whole.setting(), whole.state(), 1);
  for (int n = 0; n < 10; ++n) {
    whole.step(1e9);
    continued.step(1e9);
  }
  EXPECT_EQ(whole.state().particles.positions, continued.state().particles.positions);
  EXPECT_EQ(whole.state().link_forces, continued.state().link_forces);
}

TEST_P(Tension, OfArmsGivesTheEnergyThatTheirPowersAddUpTo) {
  const double h = 0.2;
  Setting setting;
  setting.time_step = h;
  setting.scheme = Scheme::kLeapfrog;
  setting.solver.tolerance = 1e-12;
  State state = no_particles(GetParam());
  add_particle(state, {-1, 0, 0}, 0.1, 5, {0, -1, 0});
  add_particle(state, {}, 0.1, 0.1, {0, 0.05, 0});
  add_particle(state, {1, 0, 0}, 0.1, 7, {0, 1, 0});
  add_rotation(state.particles);
  setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 1.0}}}},
                        {1, 2, PiecewiseLinearLength{{{0, 1.0}}}}};
  Simulation simulation(setting, state, 1);
  const Vector start = momentum(state.particles);
  for (int n = 0; n < 30; ++n) {
    const double before = kinetic_energy(simulation.state().particles);
    ASSERT_TRUE(simulation.step(1e9).converged);
    const auto& now = simulation.state();
    EXPECT_NEAR(h * (now.arm_powers[0] + now.arm_powers[1]), kinetic_energy(now.particles) - before,
                1e-10);
    EXPECT_NEAR(norm(momentum(now.particles) - start), 0, 1e-11);
  }
}

TEST_P(Tension, OfASwingingBodyIsOfSecondOrder) {
  // A force on one end; the turn does not depend on the motion of the centre.
  const auto angle_at = [](int dimension, int steps) {
    Setting setting;
    setting.scheme = Scheme::kLeapfrog;
    setting.time_step = 2.0 / steps;
    setting.forces[0] = constant({30, 40, 0});
    State state = no_particles(dimension);
    add_particle(state, {1, 0, 0}, 0.2, 1);
    add_particle(state, {-1, 0, 0}, 0.2, 2);
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{0, 1}});
    Simulation simulation(setting, state, 1);
    take_steps(simulation, steps);
    const auto& p = simulation.state().particles;
    const Vector along = p.position(0) - p.position(1);
    return std::atan2(along[1], along[0]);
  };
  // The angle goes from 0 to 106 degrees and back, with kappa = h² F a/I from 1.5 to 0.01.
  const double exact = angle_at(GetParam(), 20000);
  for (const int n : {8, 12, 16, 24, 32, 50, 100})
    EXPECT_LT(std::abs(angle_at(GetParam(), n) - exact), 60.0 / (n * n)) << n;
}

TEST(TensionOf, LinksThatPushBuckleByWhatTheReportSays) {
  // A mass on an arm, held at its other end, stands above the hinge: kappa = h² (m g/l)/m.
  for (const double h : {0.1, 0.5, 1.0}) {
    Setting setting;
    setting.time_step = h;
    setting.scheme = Scheme::kLeapfrog;
    setting.gravity = {0, -kGravity, 0};
    State state = no_particles(2);
    add_particle(state, {}, 0.1, 1e30);
    add_particle(state, {0, 2, 0}, 0.1, 3);
    add_rotation(state.particles);
    setting.links.hinges.emplace_back();
    setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 2}}}}};
    Simulation simulation(setting, state, 1);
    simulation.step(10);
    EXPECT_NEAR(simulation.step(10).buckling / (h * h * kGravity / 2), 1, 1e-9);
  }
}

TEST(TensionOf, ChangesNoColumnUnderLoad) {
  // Links that push have no geometric stiffness.
  LinkEquations arm{LinkEquations::Kind::kArm};
  State state = no_particles(3);
  add_particle(state, {}, 0.1, 1);
  add_particle(state, {2, 0, 0}, 0.1, 1);
  add_rotation(state.particles);
  LinkRow row;
  row.parts = {{0, {-1, 0, 0}}, {1, {1, 0, 0}}};
  arm.rows = {row};
  EXPECT_TRUE(rows_of_tension(arm, std::vector{5.0}, state.particles).empty());
  const auto rows = rows_of_tension(arm, std::vector{-5.0}, state.particles);
  ASSERT_EQ(rows.size(), 2U);
  for (const auto& across : rows) {
    EXPECT_EQ(across.stiffness, 2.5);
    EXPECT_EQ(across.parts[1].direction[0], 0);
  }
}

}  // namespace
}  // namespace viscontact::particles
