// The preconditioner, and conjugate gradients with it, of spheres in three blocks.
#include "viscontact/suspensions/linear/block_preconditioner.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/suspensions/many_pairs.hpp"
#include "viscontact/suspensions/linear/conjugate_gradients.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

class Preconditioner : public testing::TestWithParam<std::tuple<PairTerms, bool>> {
 protected:
  Preconditioner() { preconditioner.set(resistance, many.pool); }
  std::vector<Motion> solved(std::vector<Motion> loads) {
    std::vector<Motion> motions(loads.size());
    preconditioner.subtract_and_solve(0, loads, motions, many.pool);
    return motions;
  }
  ManyPairs many{11, std::get<0>(GetParam()), std::get<1>(GetParam())};
  const Resistance& resistance = many.resistance();
  BlockPreconditioner preconditioner;
  Random random{9};
  std::vector<Motion> one = random_motions(resistance.count(), random),
                      two = random_motions(resistance.count(), random);
};

TEST_P(Preconditioner, IsSymmetricAndPositive) {
  const auto by_one = solved(one), by_two = solved(two);
  const double power_one = product(one, by_one), power_two = product(two, by_two);
  EXPECT_GT(power_one, 0);
  EXPECT_GT(power_two, 0);
  // The factors of a pair have a condition number of 100 to 1000.
  EXPECT_NEAR(product(two, by_one), product(one, by_two), 1e-12 * std::sqrt(power_one * power_two));
}

TEST_P(Preconditioner, SubtractsBeforeItSolves) {
  auto loads = one;
  auto motions = two;
  const double length = 0.7;
  const double power = preconditioner.subtract_and_solve(length, loads, motions, many.pool);
  auto expected = one;
  for (std::size_t k = 0; k < one.size(); ++k) {
    expected[k].along -= length * two[k].along;
    expected[k].turn -= length * two[k].turn;
  }
  // A fused product and sum rounds once.
  EXPECT_LT(largest_difference(loads, expected), 1e-15);
  EXPECT_LT(largest_difference(motions, solved(expected)), 1e-12);
  EXPECT_NEAR(power, product(loads, motions), 1e-12 * power);
}

TEST_P(Preconditioner, HasTheSameBitsForAnyNumberOfThreads) {
  const auto expected = solved(one);
  for (const int threads : {1, 3}) {
    ThreadPool pool(threads);
    BlockPreconditioner other;
    other.set(resistance, pool);
    auto loads = one;
    std::vector<Motion> motions(one.size());
    other.subtract_and_solve(0, loads, motions, pool);
    EXPECT_TRUE(have_same_bits(motions, expected));
  }
}

TEST_P(Preconditioner, SolvesInFewIterations) {
  std::vector<Motion> loads(one.size()), motions(one.size());
  resistance.multiply(one, loads);
  ConjugateGradients gradients(many.pool);
  const auto result = gradients.solve(resistance, preconditioner, loads, motions, {0, 1e-20}, 1000);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(largest_difference(motions, one), 1e-7);
  // 10 decades of the error take 29 to 42 iterations here, and 44 to 57 without strong pairs.
  EXPECT_LT(result.iterations, 44);
}

INSTANTIATE_TEST_SUITE_P(Kinds, Preconditioner,
                         testing::Combine(testing::Values(PairTerms::kNearContact,
                                                          PairTerms::kTables),
                                          testing::Bool()));

TEST(PreconditionerOfAStar, IsTheInverseBesideATranslation) {
  // A sphere and others around it, which squeezes alone connect: the factors have no fill, and what
  // the preconditioner has beside the inverse is the translation of all by the sum of the forces.
  constexpr int kOthers = 9;
  Random random(10);
  Resistance resistance;
  double drag = 0;
  for (int k = 0; k <= kOthers; ++k) {
    resistance.spheres.push_back({random.uniform(1, 2), random.uniform(1, 2)});
    drag += resistance.spheres.back().move;
  }
  for (int k = 1; k <= kOthers; ++k) {
    PairRow row;
    row.normal = Packed(lanes_of(Vector(random.direction(3))));
    row.squeeze = random.decades(0, 3);
    row.inverse_arm = 0.5;
    row.second = k;
    resistance.pairs.push_back(row);
  }
  ThreadPool pool(1);
  resistance.blocks = RowBlocks(kOthers + 1, resistance.pairs);
  BlockPreconditioner preconditioner;
  preconditioner.set(resistance, pool);
  const auto motions = random_motions(kOthers + 1, random);
  std::vector<Motion> loads(motions.size()), solved(motions.size());
  resistance.multiply(motions, loads);
  Lanes force{};
  for (const auto& load : loads) force += load.along;
  preconditioner.subtract_and_solve(0, loads, solved, pool);
  for (auto& motion : solved) motion.along -= (1 / drag) * force;
  // Squeezes up to 1000 multiply rounding errors.
  EXPECT_LT(largest_difference(solved, motions), 1e-12);
}

}  // namespace
}  // namespace viscontact::suspensions
