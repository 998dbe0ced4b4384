// Strong pairs, and the order and the stages of the spheres, of spheres in three and in one block.
#include "viscontact/suspensions/linear/strong_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "tests/suspensions/many_pairs.hpp"

namespace viscontact::suspensions {
namespace {

using particles::PairTerms;

/// The number of the part, of those that begin at `begins` and end with its last entry, of a node.
std::size_t part_of(const std::vector<std::uint32_t>& begins, std::size_t node) {
  return static_cast<std::size_t>(std::ranges::upper_bound(begins, node) - begins.begin()) - 1;
}

class StrongPairsOfMany : public testing::TestWithParam<int> {
 protected:
  StrongPairsOfMany() {
    for (std::size_t t = 0; t < strong.spheres.size(); ++t)
      node_of[static_cast<std::size_t>(strong.spheres[t])] = t;
  }
  std::size_t node(std::int32_t sphere) const { return node_of[static_cast<std::size_t>(sphere)]; }
  ManyPairs many{GetParam(), PairTerms::kNearContact, false};
  const Resistance& resistance = many.resistance();
  StrongPairs strong{resistance, many.pool};
  std::vector<std::size_t> node_of =
      std::vector(resistance.count(), std::numeric_limits<std::size_t>::max());
};

TEST_P(StrongPairsOfMany, AreThoseWithTheLargestSqueezes) {
  std::set<std::uint32_t> rows;
  double least = std::numeric_limits<double>::infinity(), largest_other = 0;
  for (const auto& pair : strong.pairs) {
    EXPECT_TRUE(rows.insert(pair.row).second);
    const auto& row = resistance.pairs[pair.row];
    EXPECT_EQ(std::minmax(pair.earlier, pair.later), std::minmax(row.first, row.second));
    least = std::min(least, row.squeeze);
  }
  for (std::uint32_t r = 0; r < resistance.pairs.size(); ++r)
    if (!rows.contains(r)) largest_other = std::max(largest_other, resistance.pairs[r].squeeze);
  EXPECT_GT(largest_other, 0);
  EXPECT_GT(least, largest_other);
  EXPECT_GE(strong.pairs.size(), resistance.count());
}

TEST_P(StrongPairsOfMany, HaveEachSphereInOneNode) {
  EXPECT_EQ(strong.spheres.size(), resistance.count());
  for (const auto node : node_of) EXPECT_LT(node, resistance.count());
}

TEST_P(StrongPairsOfMany, AreListedByTheirNodes) {
  ASSERT_EQ(strong.pairs_begin.size(), resistance.count() + 1);
  ASSERT_EQ(strong.with_earlier_begin.size(), resistance.count() + 1);
  EXPECT_EQ(strong.pairs_begin.back(), strong.pairs.size());
  EXPECT_EQ(strong.with_earlier_begin.back(), strong.pairs.size());
  for (std::size_t t = 0; t < resistance.count(); ++t) {
    for (std::size_t e = strong.pairs_begin[t]; e < strong.pairs_begin[t + 1]; ++e) {
      EXPECT_EQ(node(strong.pairs[e].earlier), t);
      EXPECT_GT(node(strong.pairs[e].later), t);
    }
    for (std::size_t e = strong.with_earlier_begin[t]; e < strong.with_earlier_begin[t + 1]; ++e)
      EXPECT_EQ(node(strong.pairs[strong.with_earlier[e]].later), t);
  }
}

TEST_P(StrongPairsOfMany, ConnectNoTwoChunksOfAStage) {
  ASSERT_EQ(strong.chunks.front(), 0U);
  ASSERT_EQ(strong.chunks.back(), resistance.count());
  ASSERT_EQ(strong.stages.front(), 0U);
  ASSERT_EQ(strong.stages.back() + 1, strong.chunks.size());
  EXPECT_TRUE(std::ranges::is_sorted(strong.chunks));
  EXPECT_TRUE(std::ranges::is_sorted(strong.stages));
  const auto chunk_of = [&](std::int32_t sphere) { return part_of(strong.chunks, node(sphere)); };
  for (const auto& pair : strong.pairs) {
    const auto one = chunk_of(pair.earlier), two = chunk_of(pair.later);
    if (one != two) {
      EXPECT_LT(part_of(strong.stages, one), part_of(strong.stages, two));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sides, StrongPairsOfMany, testing::Values(4, 11));

}  // namespace
}  // namespace viscontact::suspensions
