// Rows between spheres, of which each block of spheres has those that add to its spheres.
#include "viscontact/suspensions/pairs/row_blocks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/common/random.hpp"
#include "viscontact/common/system/thread_pool.hpp"

namespace viscontact::suspensions {
namespace {

struct Row {
  std::int32_t first = 0, second = 0;
};

/// Rows between spheres of near numbers and of any, in order of their first spheres.
std::vector<Row> random_rows(std::size_t spheres, std::size_t count) {
  Random random(1);
  const auto last = static_cast<int>(spheres) - 1;
  std::vector<Row> rows;
  while (rows.size() < count) {
    const int i = random.integer(0, last), j = random.chance(0.5)
                                                   ? random.integer(0, last)
                                                   : std::min(i + random.integer(1, 30), last);
    if (i != j) rows.push_back({std::min(i, j), std::max(i, j)});
  }
  std::ranges::stable_sort(rows, {}, &Row::first);
  return rows;
}

/// What each sphere gets, in this order: the rows of which it is the first sphere, and -1 less the
/// rows of which it is the second one.
using Received = std::vector<std::vector<int>>;

Received received_by_blocks(std::size_t spheres, const std::vector<Row>& rows) {
  Received received(spheres);
  const RowBlocks blocks(spheres, rows, 2);
  ThreadPool pool(2);
  add_by_blocks(blocks, rows, pool, [&](std::size_t r, bool to_first, bool to_second) {
    const int number = static_cast<int>(r);
    if (to_first) received[static_cast<std::size_t>(rows[r].first)].push_back(number);
    if (to_second) received[static_cast<std::size_t>(rows[r].second)].push_back(-1 - number);
  });
  return received;
}

TEST(RowBlocks, AddEachRowToBothSpheresInTheOrderOfTheRows) {
  for (const std::size_t spheres : {2U, 511U, 512U, 513U, 1537U, 4096U, 17'000U}) {
    SCOPED_TRACE(spheres);
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, 3 * spheres}) {
      const auto rows = random_rows(spheres, count);
      Received expected(spheres);
      for (std::size_t r = 0; r < rows.size(); ++r) {
        expected[static_cast<std::size_t>(rows[r].first)].push_back(static_cast<int>(r));
        expected[static_cast<std::size_t>(rows[r].second)].push_back(-1 - static_cast<int>(r));
      }
      EXPECT_EQ(received_by_blocks(spheres, rows), expected);
    }
  }
}

TEST(RowBlocks, LeaveOutBlocksWithoutRows) {
  const std::vector<Row> rows{{3, 2000}, {3, 2001}, {1600, 2001}};
  Received expected(2100);
  expected[3] = {0, 1};
  expected[1600] = {2};
  expected[2000] = {-1};
  expected[2001] = {-2, -3};
  EXPECT_EQ(received_by_blocks(2100, rows), expected);
}

TEST(RowBlocks, FetchSpheresThatExist) {
  constexpr std::size_t kSpheres = 1537;
  const auto rows = random_rows(kSpheres, 3 * kSpheres);
  const RowBlocks blocks(kSpheres, rows, 2);
  std::size_t fetched = 0;
  for (std::size_t begin = 0; begin < kSpheres; begin += blocks.size())
    blocks.for_rows(
        rows, begin, [](std::size_t, bool, bool) {},
        [&](std::size_t k) {
          EXPECT_LT(k, kSpheres);
          ++fetched;
        });
  EXPECT_GT(fetched, rows.size());
}

}  // namespace
}  // namespace viscontact::suspensions
