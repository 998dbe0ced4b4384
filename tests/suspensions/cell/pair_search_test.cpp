#include "viscontact/suspensions/cell/pair_search.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>

#include "tests/common/random.hpp"
#include "viscontact/suspensions/cell/cell_lists.hpp"

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

TEST(PairSearch, FindsEachPairOfALatticeOnce) {
  Random random(6);
  for (int trial = 0; trial < 40; ++trial) {
    Lattice lattice;
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t e = 0; e < 3; ++e) lattice[d][e] = (d == e ? 16 : 0) + random.uniform(-9, 9);
    lattice = reduced(lattice);
    const auto heights = heights_of(lattice);
    if (std::ranges::min(heights) < 7.1) continue;
    ShearedCell cell;
    cell.lattice.emplace(lattice, Vector{random.uniform(-5, 5), 1, 2});
    std::vector<double> positions, radii;
    for (int k = 0; k < 200; ++k) {
      radii.push_back(random.uniform(0.7, 1.4));
      Vector x = cell.lattice->middle;
      for (std::size_t d = 0; d < 3; ++d) x = x + random.uniform(-0.5, 0.5) * lattice[d];
      positions.insert(positions.end(), x.begin(), x.end());
    }
    const auto found = near_pairs(cell, positions, radii, 0.5);
    std::size_t next = 0;
    for (std::size_t i = 0; i < radii.size(); ++i)
      for (std::size_t j = i + 1; j < radii.size(); ++j) {
        const Vector apart = particles::point_of(positions.data(), j, 3) -
                             particles::point_of(positions.data(), i, 3);
        // All images, of which one is so near.
        for (int x = -2; x <= 2; ++x)
          for (int y = -2; y <= 2; ++y)
            for (int z = -2; z <= 2; ++z) {
              const Vector at = apart + cell.shift_of({double(x), double(y), double(z)});
              if (norm(at) >= 1.25 * (radii[i] + radii[j])) continue;
              ASSERT_LT(next, found.size());
              EXPECT_EQ(found[next].first, static_cast<std::int32_t>(i));
              EXPECT_EQ(found[next].second, static_cast<std::int32_t>(j));
              EXPECT_LT(norm(found[next].apart - at), 1e-13);
              ++next;
            }
      }
    EXPECT_EQ(next, found.size());
  }
}

TEST(PairSearch, FindsThePairsOfAShearedCellInItsLattice) {
  Random random(7);
  constexpr double kPeriod = 12;
  ShearedCell sheared{{0, 0, 0}, {kPeriod, kPeriod, kPeriod}, 0};
  std::vector<double> positions, radii(150, 1.0);
  for (std::size_t k = 0; k < 3 * radii.size(); ++k)
    positions.push_back(random.uniform(0, kPeriod));
  const Matrix gradient{Vector{0, 1, 0}, Vector{}, Vector{}};
  Lattice lattice{Vector{kPeriod, 0, 0}, Vector{0, kPeriod, 0}, Vector{0, 0, kPeriod}};
  for (int step = 0; step < 100; ++step) {
    const double strain = random.uniform(0, 0.3);
    sheared.offset = sheared.moved_offset(strain * kPeriod);
    lattice = carried_lattice(gradient, strain, lattice);
    ShearedCell cell;
    cell.lattice.emplace(lattice, Vector{6, 6, 6});
    auto wrapped = positions;
    for (std::size_t k = 0; k < radii.size(); ++k) {
      const Vector x = cell.wrapped(particles::point_of(positions.data(), k, 3));
      std::ranges::copy(x, &wrapped[3 * k]);
    }
    const auto one = near_pairs(sheared, positions, radii, 0.5);
    const auto other = near_pairs(cell, wrapped, radii, 0.5);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t p = 0; p < one.size(); ++p) {
      EXPECT_EQ(one[p].first, other[p].first);
      EXPECT_EQ(one[p].second, other[p].second);
      EXPECT_LT(norm(one[p].apart - other[p].apart), 1e-12 * kPeriod);
    }
  }
}

TEST(PairSearch, NeedsLittleMemoryInADiluteBox) {
  const auto most_kilobytes = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
  };
  const auto before = most_kilobytes();
  ShearedCell cell{{0, 0, 0}, {1000, 1000, 1000}, 200};
  expect_all_pairs(cell, {1, 1, 1, 999.5, 2, 1}, {1, 1}, 1.5);
  expect_all_pairs(cell, {1, 1, 1, 801, 999, 1}, {1, 1}, 0.5);
  // Three cells an axis; those of the largest distance of a pair would take 1e8 numbers.
  EXPECT_LT(most_kilobytes() - before, 10'000);
}

TEST(CellsAlong, AreNoMoreThanElementsAndAsWideAsTheReach) {
  using Cells = std::array<std::int64_t, 3>;
  EXPECT_EQ(cells_along({1e9, 1e9, 1e9}, 1, 2), (Cells{3, 3, 3}));
  EXPECT_EQ(cells_along({0, 1e9, 1e9}, 1, 2), (Cells{1, 5, 5}));
  EXPECT_EQ(cells_along({5.9, 7.1, 6}, 2, 1000), (Cells{2, 3, 3}));
  EXPECT_EQ(cells_along({20, 20, 20}, 1, 1000), (Cells{10, 10, 10}));
  // What short axes leave is for the long one.
  EXPECT_EQ(cells_along({100, 3, 3}, 1, 1000), (Cells{100, 3, 3}));
  EXPECT_EQ(cells_along({1000, 3, 3}, 1, 1000), (Cells{111, 3, 3}));
}

}  // namespace
}  // namespace viscontact::suspensions
