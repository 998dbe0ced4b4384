// The instantaneous problem in another order, mirrored, shifted, turned, and in other units.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPeriod = 8.5, kOffset = 1.7;
// Conjugate gradients end at 1e-11 of the dissipation.
constexpr double kBar = 1e-9;

struct Solved {
  std::vector<RelativeMotion> motions;
  Rheology rheology;
};

Solved solved(const Setting& setting, const State& state) {
  SuspensionSimulation simulation(setting, state, 1);
  Solved result{{}, simulation.solve_instant()};
  for (std::size_t k = 0; k < state.particles.count(); ++k)
    result.motions.push_back(relative_motion(simulation, setting, k));
  return result;
}

void expect_same(const Solved& a, const Solved& b) {
  EXPECT_LT(largest_difference(a.motions, b.motions), kBar);
  EXPECT_NEAR(a.rheology.viscosity, b.rheology.viscosity, kBar);
  EXPECT_NEAR(a.rheology.n1, b.rheology.n1, kBar);
  EXPECT_NEAR(a.rheology.n2, b.rheology.n2, kBar);
  EXPECT_NEAR(a.rheology.pressure, b.rheology.pressure, kBar);
}

class InstantInvariance : public testing::TestWithParam<PairTerms> {
 protected:
  InstantInvariance() {
    setting.lubrication->pairs = GetParam();
    setting.lubrication->repulsion = Repulsion{10, 0.05};
  }
  Random random{21};
  State state = random_spheres(kPeriod, kOffset, two_sizes(26), 1e-3, random);
  Setting setting = sheared_cube(kPeriod, kOffset);
};

TEST_P(InstantInvariance, OfTheOrderOfSpheres) {
  const auto order = shuffled(26);
  const auto there = solved(setting, reordered(state, order));
  auto here = solved(setting, state);
  std::vector<RelativeMotion> sorted;
  for (const auto k : order) sorted.push_back(here.motions[k]);
  here.motions = sorted;
  expect_same(here, there);
}

TEST_P(InstantInvariance, OfAMirrorAcrossTheVorticity) {
  const auto behind = displaced(state, [](const Vector& x) {
    return Vector{x[0], x[1], kPeriod - x[2]};
  });
  auto there = solved(setting, behind);
  there.motions = mirrored(there.motions);
  expect_same(solved(setting, state), there);
}

TEST_P(InstantInvariance, OfTheOrigin) {
  const Vector shift{300, -200, 70};
  const auto there = displaced(state, [&](const Vector& x) { return x + shift; });
  auto shifted = setting;
  shifted.domain = BoxDomain{shift, shift + Vector{kPeriod, kPeriod, kPeriod}, {true, true, true}};
  expect_same(solved(setting, state), solved(shifted, there));
}

TEST_P(InstantInvariance, OfTheCellAmongItsImages) {
  std::vector<Vector> places;
  for (std::size_t k = 0; k < 26; ++k) {
    auto x = state.particles.position(k) + Vector{1.3, 2.9, -3.1};
    if (x[1] >= kPeriod) x = x - Vector{kOffset, kPeriod, 0};
    places.push_back(x);
  }
  expect_same(solved(setting, state), solved(setting, spheres_at(places, state.particles.radii)));
}

TEST_P(InstantInvariance, OfUnits) {
  for (int trial = 0; trial < 5; ++trial) {
    const double length = random.decades(-5, 5), time = random.decades(-5, 5);
    const double mass = random.decades(-5, 5);
    auto other = sheared_cube(length * kPeriod, length * kOffset);
    auto& of = *other.lubrication;
    of.pairs = GetParam();
    of.viscosity = mass / (length * time);
    of.gradient[0][1] = 1 / time;
    of.repulsion = Repulsion{10 * mass / (time * time), 0.05 * length};
    auto there = solved(other, scaled(state, length));
    there.motions = in_units(there.motions, length, time);
    expect_same(solved(setting, state), there);
  }
}

TEST_P(InstantInvariance, OfTheDirectionOfTheAxes) {
  // Without periods, in a frame that is turned about the axis (1, 2, 3).
  setting.domain = {};
  auto turned_setting = setting;
  const Vector axis{1, 2, 3};
  const auto turn = turned({1, 0, 0, 0}, axis);
  const std::array<Vector, 3> columns{rotated(turn, {1, 0, 0}), rotated(turn, {0, 1, 0}),
                                      rotated(turn, {0, 0, 1})};
  // u = e_x (e_y.x) becomes columns[0] (columns[1].x).
  for (std::size_t i = 0; i < 3; ++i)
    turned_setting.lubrication->gradient[i] = columns[0][i] * columns[1];
  std::vector<Vector> places;
  for (std::size_t k = 0; k < 26; ++k) places.push_back(rotated(turn, state.particles.position(k)));
  auto here = solved(setting, state),
       there = solved(turned_setting, spheres_at(places, state.particles.radii));
  for (auto& motion : here.motions) {
    motion.along = rotated(turn, motion.along);
    motion.turn = rotated(turn, motion.turn);
  }
  EXPECT_LT(largest_difference(here.motions, there.motions), kBar);
}

INSTANTIATE_TEST_SUITE_P(Pairs, InstantInvariance,
                         testing::Values(PairTerms::kNearContact, PairTerms::kTables));

}  // namespace
}  // namespace viscontact::particles
