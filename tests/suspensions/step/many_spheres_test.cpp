// Steps of spheres, pairs and contacts in several blocks of loops.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/suspensions/cell/pair_search.hpp"
#include "viscontact/suspensions/cell/sheared_cell.hpp"
#include "viscontact/suspensions/pairs/row_blocks.hpp"

namespace viscontact::particles {
namespace {
using suspensions::BlockTuning;
using suspensions::kPairsInBlock;
using suspensions::ShearedCell;

/// Spheres on a lattice that is disturbed, in a sheared cube, which random forces push against each
/// other.
struct PushedLattice {
  PushedLattice(int spheres_in_line, const StepKind& kind) : side(spheres_in_line) {
    Random random(3);
    start = disturbed_lattice(side, kSpacing, 0.01, random);
    setting = sheared_cube(side * kSpacing, 0, kind);
    setting.time_step = 0.02;
    for (std::size_t k = 0; k < start.particles.positions.size(); ++k)
      setting.added_forces.push_back(random.uniform(-600, 600));
    setting.added_torques.assign(setting.added_forces.size(), 0);
  }
  static constexpr double kSpacing = 2.04;
  int side;
  State start;
  Setting setting;
};

const StepKind kSmooth{PairTerms::kNearContact, 0, 1e-2, 0};
const StepKind kWithFriction{PairTerms::kNearContact, 0, 1e-2, 0.5};

TEST(ManySpheres, HaveTheSmallestGapOfAllPairs) {
  const PushedLattice lattice(12, {PairTerms::kNearContact, 1e-3, 0, 0});
  SuspensionSimulation simulation(lattice.setting, lattice.start, 1);
  EXPECT_TRUE(simulation.step(1).converged);
  const auto& state = simulation.state();
  const double period = lattice.side * lattice.kSpacing;
  const ShearedCell cell{{}, {period, period, period}, state.shear.offset};
  const auto& p = state.particles;
  double least = std::numeric_limits<double>::infinity();
  const auto pairs = suspensions::near_pairs(cell, p.positions, p.radii, 0.5);
  for (const auto& pair : pairs) least = std::min(least, norm(pair.apart) - 2);
  EXPECT_GT(pairs.size(), kPairsInBlock);
  // The gap of the step is that of its last motions.
  EXPECT_NEAR(simulation.rheology().smallest_gap, least, 1e-12);
}

TEST(ManySpheres, WithoutPairsHaveNoSmallestGap) {
  auto setting = sheared_cube(20, 0);
  setting.time_step = 0.01;
  SuspensionSimulation simulation(setting, spheres_at({{1, 1, 1}, {9, 9, 9}}, {1, 1}), 1);
  EXPECT_EQ(simulation.solve_instant().smallest_gap, std::numeric_limits<double>::infinity());
  simulation.step(0.01);
  EXPECT_EQ(simulation.rheology().pairs, 0U);
  EXPECT_EQ(simulation.rheology().smallest_gap, std::numeric_limits<double>::infinity());
}

TEST(ManySpheres, HaveTheSameBitsForAnyNumberOfThreads) {
  for (const auto& kind : {kSmooth, kWithFriction}) {
    SCOPED_TRACE(kind.friction);
    const PushedLattice lattice(16, kind);
    ASSERT_EQ(lattice.start.particles.count(), 8 * BlockTuning::kSpheres);
    State of_one;
    for (const int threads : {1, 2, 3}) {
      SuspensionSimulation simulation(lattice.setting, lattice.start, threads);
      EXPECT_TRUE(simulation.step(1).converged);
      const auto& state = simulation.state();
      EXPECT_GT(simulation.rheology().pairs, kPairsInBlock);
      EXPECT_GT(simulation.rheology().contacts, 1000U);
      if (threads == 1) of_one = state;
      EXPECT_TRUE(state.particles.positions == of_one.particles.positions);
      EXPECT_TRUE(state.particles.angular_velocities == of_one.particles.angular_velocities);
      EXPECT_TRUE(state.pairs == of_one.pairs);
    }
  }
}

TEST(ManySpheres, WithFrictionDoNotDependOnTheirOrder) {
  const PushedLattice lattice(10, kWithFriction);
  const std::size_t count = lattice.start.particles.count();
  ASSERT_GT(count, BlockTuning::kSpheres);
  const auto order = shuffled(count);
  auto other = lattice.setting;
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t d = 0; d < 3; ++d)
      other.added_forces[3 * k + d] = lattice.setting.added_forces[3 * order[k] + d];
  SuspensionSimulation here(lattice.setting, lattice.start, 1),
      there(other, reordered(lattice.start, order), 1);
  const auto one = here.step(1), two = there.step(1);
  for (const auto& report : {one, two}) {
    EXPECT_TRUE(report.converged);
    // With slips in a wrong order the linear problems end at their most iterations, 5000 each.
    EXPECT_LT(report.iterations, 5000);
  }
  EXPECT_GT(here.rheology().contacts, 200U);
  std::vector<RelativeMotion> sorted, motions;
  for (std::size_t k = 0; k < count; ++k) {
    sorted.push_back(relative_motion(here, lattice.setting, order[k]));
    motions.push_back(relative_motion(there, other, k));
  }
  EXPECT_LT(largest_difference(sorted, motions), 1e-9);
}

}  // namespace
}  // namespace viscontact::particles
