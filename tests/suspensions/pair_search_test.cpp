#include "viscontact/suspensions/pair_search.hpp"

#include <gtest/gtest.h>

#include "tests/common/random.hpp"

namespace viscontact::suspensions {
namespace {

void expect_all_pairs(const ShearedCell& cell, const std::vector<double>& positions,
                      const std::vector<double>& radii, double range) {
  const auto found = near_pairs(cell, positions, radii, range);
  auto next = found.begin();
  for (std::size_t i = 0; i < radii.size(); ++i)
    for (std::size_t j = i + 1; j < radii.size(); ++j) {
      const Vector apart = cell.nearest(particles::point_of(positions.data(), j, 3) -
                                        particles::point_of(positions.data(), i, 3));
      if (norm(apart) - radii[i] - radii[j] >= range * (radii[i] + radii[j]) / 2) continue;
      ASSERT_NE(next, found.end());
      EXPECT_EQ(next->first, static_cast<std::int32_t>(i));
      EXPECT_EQ(next->second, static_cast<std::int32_t>(j));
      EXPECT_EQ(next->apart, apart);
      ++next;
    }
  EXPECT_EQ(next, found.end());
}

TEST(PairSearch, FindsEachPairOnce) {
  Random random(5);
  for (int trial = 0; trial < 60; ++trial) {
    const bool is_small = trial % 3 == 0;
    const double length = is_small ? 8 : random.uniform(10, 30);
    ShearedCell cell{{random.uniform(-5, 5), 1, 2}, {length, length, 1.1 * length}, 0};
    if (trial % 4 == 1) cell.lengths[2] = 0;
    if (trial % 4 == 2) cell.lengths = {};
    if (cell.lengths[1] > 0) cell.offset = random.uniform(-length / 2, length / 2);
    std::vector<double> positions, radii;
    for (int k = 0; k < (is_small ? 30 : 200); ++k) {
      radii.push_back(random.uniform(0.7, 1.4));
      for (std::size_t d = 0; d < 3; ++d)
        positions.push_back(cell.from[d] + random.uniform(0, length));
    }
    expect_all_pairs(cell, positions, radii, 0.5);
  }
}

}  // namespace
}  // namespace viscontact::suspensions
