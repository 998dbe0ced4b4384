// Steps of spheres in another order.
#include "viscontact/suspensions/step/sphere_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "tests/suspensions/many_pairs.hpp"
#include "tests/suspensions/spheres.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"

namespace viscontact::suspensions {
namespace {

TEST(SpatialOrder, FollowsMortonsCurve) {
  // The points of a 4 x 4 x 4 grid by a digit of each coordinate in turn, that of z first.
  std::vector<double> positions;
  std::vector<std::int32_t> expected(64);
  for (int k = 0; k < 64; ++k) {
    const int x = k % 4, y = k / 4 % 4, z = k / 16;
    for (const int coordinate : {x, y, z}) positions.push_back(7 + 0.1 * coordinate);
    const int place =
        (x & 1) + 2 * (y & 1) + 4 * (z & 1) + 4 * (x & 2) + 8 * (y & 2) + 16 * (z & 2);
    expected[static_cast<std::size_t>(place)] = k;
  }
  EXPECT_EQ(spatial_order(positions), expected);
}

TEST(SpatialOrder, OfSpheresAtOnePlaceIsThatOfTheirNumbers) {
  EXPECT_EQ(spatial_order(std::vector<double>(9, 1.5)), (std::vector<std::int32_t>{0, 1, 2}));
}

/// Spheres on a plane, pushed against each other at random in a shear flow, with friction.
struct PushedSpheres {
  static constexpr int kSide = 6;
  static constexpr double kSpacing = 2.04;
  PushedSpheres() {
    Random random(12);
    const auto state = particles::disturbed_lattice(kSide, kSpacing, 0.01, random);
    radii = state.particles.radii;
    const ShearedCell cell{{}, {kSide * kSpacing, 0, kSide * kSpacing}, 0};
    problem.lubrication.viscosity = 1;
    problem.lubrication.pairs = particles::PairTerms::kNearContact;
    problem.lubrication.roughness = 1e-2;
    problem.lubrication.gradient[0][1] = 1;
    problem.gradient = problem.lubrication.gradient;
    problem.friction = 0.5;
    problem.h = 0.02;
    problem.pool = &pool;
    problem.pairs = near_pairs(cell, state.particles.positions, radii, problem.lubrication.range);
    const auto plane = static_cast<std::int32_t>(radii.size());
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const double height = state.particles.position(k)[1];
      if (height < 1 + problem.lubrication.range)
        problem.pairs.push_back({static_cast<std::int32_t>(k), plane, {0, -height, 0}});
    }
    std::ranges::sort(problem.pairs, {},
                      [](const NearPair& pair) { return std::pair(pair.first, pair.second); });
    problem.loads = random_motions(radii.size(), random);
    for (auto& load : problem.loads) load.along = 1500 * load.along - Lanes{0, 500, 0, 0};
    radii.push_back(std::numeric_limits<double>::infinity());
    problem.loads.emplace_back();
    problem.motions.resize(radii.size());
    problem.radii = radii;
  }
  ThreadPool pool{1};
  std::vector<double> radii;
  StepProblem problem;
};

TEST(StepInOrder, IsTheSameStepWithFriction) {
  PushedSpheres spheres;
  auto& problem = spheres.problem;
  // The step after a first one, whose contacts have loads and friction.
  problem.memories = SuspensionStep(problem).solve().contacts;
  ASSERT_GT(problem.memories.size(), 50U);
  const auto expected = SuspensionStep(problem).solve();
  ASSERT_TRUE(expected.converged);
  const std::size_t count = spheres.radii.size() - 1;
  std::vector<std::int32_t> order;
  for (const auto k : particles::shuffled(count)) order.push_back(static_cast<std::int32_t>(k));
  const auto solution = solve_in_order(problem, order);
  EXPECT_TRUE(solution.converged);
  ASSERT_EQ(solution.motions.size(), expected.motions.size());
  double fastest = 0;
  for (const auto& motion : expected.motions)
    fastest = std::max(fastest, norm(vector_of(motion.along)));
  // The last linear problems are solved far better than to the error of a step, 3e-9.
  EXPECT_LT(largest_difference(solution.motions, expected.motions), 1e-9 * fastest);
  EXPECT_NEAR(solution.dissipation, expected.dissipation, 1e-9 * expected.dissipation);
  EXPECT_NEAR(solution.smallest_gap, expected.smallest_gap, 1e-9);
  EXPECT_EQ(solution.touching, expected.touching);
  ASSERT_EQ(solution.contacts.size(), expected.contacts.size());
  double largest = 0, with_plane = 0;
  for (const auto& contact : expected.contacts) largest = std::max(largest, contact.load);
  for (std::size_t c = 0; c < expected.contacts.size(); ++c) {
    const auto &one = solution.contacts[c], &two = expected.contacts[c];
    EXPECT_EQ(std::pair(one.first, one.second), std::pair(two.first, two.second));
    EXPECT_NEAR(one.load, two.load, 1e-9 * largest);
    for (std::size_t d = 0; d < 3; ++d)
      EXPECT_NEAR(one.friction[d], two.friction[d], 1e-9 * largest);
    if (static_cast<std::size_t>(two.second) == count) ++with_plane;
  }
  EXPECT_GT(with_plane, 5);
}

}  // namespace
}  // namespace viscontact::suspensions
