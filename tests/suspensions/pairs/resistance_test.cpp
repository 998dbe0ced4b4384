// Products with the resistance of spheres in three blocks.
#include "viscontact/suspensions/pairs/resistance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/suspensions/many_pairs.hpp"
#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

class ResistanceOfManyPairs : public testing::TestWithParam<std::tuple<PairTerms, bool>> {
 protected:
  std::vector<Motion> loads_of_all(const std::vector<Motion>& motions) const {
    std::vector<Motion> loads(motions.size());
    resistance.multiply(motions, loads);
    return loads;
  }
  ManyPairs many{11, std::get<0>(GetParam()), std::get<1>(GetParam())};
  const Resistance& resistance = many.resistance();
  Random random{6};
  std::vector<Motion> one = random_motions(resistance.count(), random),
                      two = random_motions(resistance.count(), random);
};

// A load sums the terms of some 10 pairs, the largest of which, 1/gap, is some hundred: products of
// these have rounding errors of 1e-13.
constexpr double kRounding = 1e-12;

TEST_P(ResistanceOfManyPairs, IsSymmetricAndPositive) {
  const auto by_one = loads_of_all(one), by_two = loads_of_all(two);
  const double power_one = product(one, by_one), power_two = product(two, by_two);
  EXPECT_GT(power_one, 0);
  EXPECT_GT(power_two, 0);
  EXPECT_NEAR(product(two, by_one), product(one, by_two),
              kRounding * std::sqrt(power_one * power_two));
}

TEST_P(ResistanceOfManyPairs, HasTheSameProductByBlocks) {
  ASSERT_GT(resistance.count(), 2 * resistance.blocks.size());
  const auto expected = loads_of_all(one);
  const double power = product(one, expected);
  std::vector<Motion> of_one_thread(one.size());
  for (const int threads : {1, 2, 3}) {
    ThreadPool pool(threads);
    auto divided = resistance;
    divided.blocks =
        RowBlocks(resistance.count(), resistance.pairs, static_cast<std::size_t>(threads));
    const ResistanceProduct by_blocks(divided, pool);
    std::vector<Motion> loads(one.size());
    EXPECT_NEAR(by_blocks.multiply(one, loads), power, kRounding * power);
    EXPECT_LT(largest_difference(loads, expected),
              kRounding * largest_difference(expected, std::vector<Motion>(one.size())));
    if (threads == 1) of_one_thread = loads;
    EXPECT_TRUE(have_same_bits(loads, of_one_thread));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ResistanceOfManyPairs,
                         testing::Combine(testing::Values(PairTerms::kNearContact,
                                                          PairTerms::kTables),
                                          testing::Bool()));

TEST(Resistance, HasAsManyForcesAsCounterforces) {
  const ManyPairs many(11, PairTerms::kNearContact, true);
  Random random(7);
  const auto motions = random_motions(many.resistance().count(), random);
  std::vector<Motion> loads(motions.size());
  many.resistance().multiply(motions, loads);
  // What is left are the drags.
  Lanes sum{}, velocities{};
  for (std::size_t k = 0; k < motions.size(); ++k) {
    sum += loads[k].along;
    velocities += motions[k].along;
  }
  const double largest = largest_difference(loads, std::vector<Motion>(motions.size()));
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(sum[d], 6 * M_PI * velocities[d], kRounding * largest);
}

TEST(Resistance, IsSymmetricWithTheRateAmongTheUnknowns) {
  // 512 spheres are a block, so that the rate of 8^3 of them is in a block without rows.
  for (const int side : {8, 9}) {
    ManyPairs many(side, PairTerms::kNearContact, false);
    Random random(8);
    auto& resistance = many.system.resistance();
    const std::size_t count = resistance.count();
    resistance.rate.loads = random_motions(count, random);
    resistance.spheres.push_back({0, 1e5});
    // The rate is component 0 of the turn of the last entry; others do not move.
    const auto motions = [&](double rate) {
      auto of_spheres = random_motions(count, random);
      of_spheres.push_back(Motion{Lanes{}, Lanes{rate, 0, 0, 0}});
      return of_spheres;
    };
    const auto one = motions(0.3), two = motions(-2);
    std::vector<Motion> by_one(count + 1), by_two(count + 1), by_blocks(count + 1);
    resistance.multiply(one, by_one);
    resistance.multiply(two, by_two);
    const double power = product(one, by_one);
    EXPECT_NEAR(product(two, by_one), product(one, by_two), kRounding * power);
    EXPECT_NEAR(by_one.back().turn[0],
                product(std::span(one).first(count), resistance.rate.loads) + 0.3e5, 1e-6);
    EXPECT_NEAR(ResistanceProduct(resistance, many.pool).multiply(one, by_blocks), power,
                kRounding * power);
    EXPECT_LT(largest_difference(by_blocks, by_one), kRounding * 0.3e5);
  }
}

TEST(Resistance, OfFixedBodiesIsNoLoad) {
  // A sphere between two others, of which the last is fixed.
  Resistance resistance;
  resistance.spheres.assign(3, {2, 3});
  PairRow row;
  row.normal = Packed(Lanes{0, 1, 0, 0});
  row.squeeze = 5;
  row.inverse_arm = 0.5;
  row.first = 0;
  row.second = 1;
  resistance.pairs.push_back(row);
  row.first = 1;
  row.second = 2;
  resistance.pairs.push_back(row);
  ThreadPool pool(1);
  resistance.blocks = RowBlocks(3, resistance.pairs);
  resistance.fixed = 1;
  std::vector<Motion> motions(3), loads(3), by_blocks(3);
  motions[1].along = Lanes{0, 1, 0, 0};
  resistance.multiply(motions, loads);
  const double power = ResistanceProduct(resistance, pool).multiply(motions, by_blocks);
  EXPECT_EQ(power, 2 + 2 * 5);
  EXPECT_EQ(loads[0].along[1], -5);
  EXPECT_EQ(loads[1].along[1], 12);
  EXPECT_EQ(loads[2].along[1], 0);
  EXPECT_TRUE(have_same_bits(loads, by_blocks));
}

}  // namespace
}  // namespace viscontact::suspensions
