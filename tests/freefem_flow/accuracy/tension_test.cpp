// Chains of discs that are pulled in the fluid of FreeFEM: a motion across the chain decays at
// every step. Viscosity 1, radius 0.3. Docs: physics.md (6.15).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::RigidConstraint;
using particles::Vector;

constexpr double kRadius = 0.3, kForce = 1000;

/// A disc at 0 that is fixed, a second one below it that is `aside` and a third one that is pulled
/// down, at distances of about `apart`.
struct PulledChain {
  double h = 0.05, mass = 0, density = 0, apart = 1.5, aside = 0.05;
  particles::Links links{};
  double film = 0;  ///< impulse that the films of both pairs have absorbed [M/T]

  particles::FluidSimulation simulation() const {
    particles::Setting setting;
    setting.domain = particles::BoxDomain{{-3, -5}, {3, 2}, {}};
    setting.fluid = fluid_with(8, RigidConstraint::kRigid);
    setting.fluid->threshold_gap = 0.05;
    setting.fluid->density = density;
    setting.time_step = h;
    setting.links = links;
    setting.given_motions[0] = {};
    setting.forces[2] = {{{1e300, {0, -kForce, 0}}}};
    particles::State state;
    auto& p = state.particles;
    p.dimension = 2;
    const double down = std::sqrt(apart * apart - (film > 0 ? aside * aside : 0));
    p.positions = {0, 0, aside, -down, 0, -2 * down};
    p.radii.assign(3, kRadius);
    p.masses.assign(3, mass);
    p.inertias.assign(3, mass * kRadius * kRadius / 2);
    p.velocities.assign(6, 0);
    p.angles.assign(3, 0);
    p.angular_velocities.assign(3, 0);
    for (std::int32_t k = 0; k < 2 && film > 0; ++k) {
      particles::Pair pair{k, k + 1};
      pair.gamma = -film;
      state.pairs.push_back(pair);
    }
    return {setting, state,
            start_fluid_solver(*setting.fluid, setting.domain, shapes_of(p), p.dimension)};
  }
};

particles::Links springs() { return {{}, {{0, 1, 1e6, 1.499}, {1, 2, 1e6, 1.499}}, {}}; }

particles::Links arms(double aside) {
  const particles::ArmLength length =
      particles::PiecewiseLinearLength{{{0, std::hypot(1.5, aside)}}};
  return {{}, {}, {{0, 1, length}, {1, 2, length}}};
}

/// Places of the middle disc along x and of the last one along y, after each of `steps` steps.
std::vector<std::array<double, 2>> places(const PulledChain& chain, int steps) {
  auto simulation = chain.simulation();
  std::vector<std::array<double, 2>> result;
  for (int n = 0; n < steps; ++n) {
    EXPECT_TRUE(simulation.step(1e9).converged);
    const auto& x = simulation.state().particles.positions;
    result.push_back({x[2], x[5]});
  }
  return result;
}

TEST(PulledChain, WithoutMassComesToRestOnItsLineAtEveryStep) {
  // The extension of both springs by 1e-3 leaves the last disc at -3. The first turn lengthens the
  // links by some 0.05^2/(2 1.5) each, which the next steps take back.
  for (const double h : {0.05, 1.0}) {
    SCOPED_TRACE(h);
    const auto x = places({.h = h, .links = springs()}, 7);
    for (std::size_t n = 0; n < x.size(); ++n) {
      EXPECT_LT(std::abs(x[n][0]), 0.05 * std::pow(0.5, static_cast<double>(n + 1)));
      EXPECT_GT(x[n][0], -1e-6);
      EXPECT_NEAR(x[n][1], -3, 2.5e-3);
    }
    EXPECT_NEAR(x.back()[1], -3, 1e-5);
  }
}

TEST(PulledChain, OfFilmsComesToRestOnItsLine) {
  const auto x = places({.h = 0.02, .apart = 0.65, .aside = 0.03, .links = {}, .film = 1e4}, 6);
  EXPECT_LT(std::abs(x[0][0]), 0.02);
  for (std::size_t n = 1; n < x.size(); ++n)
    EXPECT_LT(std::abs(x[n][0]), 0.7 * std::abs(x[n - 1][0]));
  EXPECT_NEAR(x.back()[1], -1.3, 1e-4);
}

TEST(PulledChain, WithMassesOrInertiaOfTheFluidDoesNotGrow) {
  // Steps of 0.05 of the chain with masses were unstable, and 0.2 with inertia of the fluid.
  for (const double density : {0.0, 1.0}) {
    SCOPED_TRACE(density);
    const double aside = 0.01;
    const auto x = places({.h = density > 0 ? 0.2 : 0.05,
                           .mass = 1,
                           .density = density,
                           .aside = aside,
                           .links = density > 0 ? springs() : arms(aside)},
                          8);
    for (const auto& place : x) EXPECT_LT(std::abs(place[0]), aside);
    EXPECT_LT(std::abs(x.back()[0]), aside / 3);
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
