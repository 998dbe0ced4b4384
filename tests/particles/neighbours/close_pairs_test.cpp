// The cell lists against all pairs looked at one by one.
#include "viscontact/particles/neighbours/close_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {

void PrintTo(const ClosePair& pair, std::ostream* out) { *out << pair.first << '-' << pair.second; }

namespace {

struct Points {
  int dimension;
  std::vector<double> positions, extents;
};

std::vector<ClosePair> all_close_pairs(const Points& points) {
  std::vector<ClosePair> pairs;
  const auto d = static_cast<std::size_t>(points.dimension);
  for (std::size_t i = 0; i < points.extents.size(); ++i)
    for (std::size_t j = i + 1; j < points.extents.size(); ++j) {
      double square = 0;
      for (std::size_t k = 0; k < d; ++k) {
        const double x = points.positions[j * d + k] - points.positions[i * d + k];
        square += x * x;
      }
      const double reach = points.extents[i] + points.extents[j];
      if (square < reach * reach)
        pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
  return pairs;
}

/// Equal means sorted and unique too: the pairs one by one come in that order.
void expect_all_found(const Points& points) {
  const auto expected = all_close_pairs(points);
  for (const int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    const auto found = close_pairs(points.dimension, points.positions, points.extents, pool);
    ASSERT_EQ(found, expected) << threads << " threads";
  }
}

Points random_points(int dimension, std::size_t count, double width, double decades_of_extent,
                     Random& random) {
  Points points{dimension, {}, {}};
  for (std::size_t k = 0; k < count; ++k) {
    points.extents.push_back(random.decades(-decades_of_extent, 0));
    for (int d = 0; d < dimension; ++d)
      points.positions.push_back(random.uniform(-width / 2, width / 2));
  }
  return points;
}

class Neighbours : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Neighbours, ::testing::Values(1, 2, 3));

TEST_P(Neighbours, AreFoundWhateverTheSpreadOfExtents) {
  Random random(1);
  for (const double decades : {0.0, 0.3, 2.0, 6.0})
    for (const std::size_t count : {2U, 17U, 300U, 1000U})
      for (const double neighbours : {0.1, 3.0, 30.0}) {
        // Of extent 1 so many would be close to each.
        const double width = 2 * std::pow(static_cast<double>(count) / neighbours,
                                          1.0 / static_cast<double>(GetParam()));
        SCOPED_TRACE(::testing::Message()
                     << count << " over " << decades << " decades in " << width);
        expect_all_found(random_points(GetParam(), count, width, decades, random));
      }
}

TEST_P(Neighbours, AreFoundInClustersFarApart) {
  Random random(2);
  for (const double distance : {30.0, 1e5, 1e12}) {
    Points points{GetParam(), {}, {}};
    for (int cluster = 0; cluster < 8; ++cluster) {
      const Vector centre = distance * random.direction(GetParam());
      for (int k = 0; k < 60; ++k) {
        points.extents.push_back(random.decades(-2, 0));
        for (std::size_t d = 0; d < static_cast<std::size_t>(GetParam()); ++d)
          points.positions.push_back(centre[d] + random.uniform(-3, 3));
      }
    }
    SCOPED_TRACE(distance);
    expect_all_found(points);
  }
}

TEST_P(Neighbours, AreFoundBesideParticlesThatFled) {
  Random random(3);
  for (const double distance : {1e6, 1e12, 1e100}) {
    auto points = random_points(GetParam(), 400, 20, 2, random);
    for (int k = 0; k < 3; ++k)
      points.positions[static_cast<std::size_t>(k * 7 + k % 2)] = distance * random.uniform(-1, 1);
    SCOPED_TRACE(distance);
    expect_all_found(points);
  }
}

TEST_P(Neighbours, AreAllWhoShareAPoint) {
  Points points{GetParam(), {}, std::vector<double>(70, 0.5)};
  points.positions.assign(70 * static_cast<std::size_t>(GetParam()), -3.25);
  ThreadPool pool(1);
  EXPECT_EQ(close_pairs(GetParam(), points.positions, points.extents, pool).size(), 70U * 69 / 2);
  expect_all_found(points);
}

TEST_P(Neighbours, OfOneOrNoneAreNone) {
  ThreadPool pool(1);
  EXPECT_TRUE(close_pairs(GetParam(), {}, {}, pool).empty());
  const std::vector<double> position(static_cast<std::size_t>(GetParam()), -1e9), extent{3};
  EXPECT_TRUE(close_pairs(GetParam(), position, extent, pool).empty());
}

TEST_P(Neighbours, OnALatticeAreFoundThoughTheyAreCloseByARoundingOnly) {
  // Extents a little above half the spacing: rows of cells' bounds fall on particles, and each
  // neighbour is as far as a cell is wide.
  for (const double spacing : {1.0, 0.1, 2.1, 1 / 3.0})
    for (const double shift : {0.0, 1e3, -1e5}) {
      Points points{GetParam(), {}, {}};
      const int side = GetParam() == 2 ? 24 : 9;
      const int rows = GetParam() == 1 ? 1 : side, layers = GetParam() == 3 ? side : 1;
      for (int z = 0; z < layers; ++z)
        for (int y = 0; y < rows; ++y)
          for (int x = 0; x < side; ++x) {
            points.positions.push_back(shift + spacing * x);
            if (GetParam() > 1) points.positions.push_back(spacing * y - shift);
            if (GetParam() == 3) points.positions.push_back(spacing * z);
            points.extents.push_back(spacing / 2 *
                                         (1 + 1e3 * std::numeric_limits<double>::epsilon()) +
                                     std::abs(shift) * std::numeric_limits<double>::epsilon());
          }
      SCOPED_TRACE(::testing::Message() << spacing << " + " << shift);
      expect_all_found(points);
    }
}

/// Width of a space in which so many points have few neighbours each; `in_plane` in two dimensions.
double width_for(int dimension, std::size_t count, double in_plane) {
  return dimension == 1 ? static_cast<double>(count) : dimension == 2 ? in_plane : 50;
}

TEST_P(Neighbours, AreTheSameForAnyNumberOfThreadsInManyBlocks) {
  Random random(4);
  constexpr std::size_t kCount = 3 * ThreadPool::kBlock + 5;
  const auto points =
      random_points(GetParam(), kCount, width_for(GetParam(), kCount, 300), 1, random);
  ThreadPool one(1);
  const auto expected = close_pairs(GetParam(), points.positions, points.extents, one);
  EXPECT_GT(expected.size(), ThreadPool::kBlock);
  EXPECT_TRUE(std::ranges::is_sorted(expected, [](const ClosePair& a, const ClosePair& b) {
    return std::pair(a.first, a.second) < std::pair(b.first, b.second);
  }));
  for (const int threads : {2, 5}) {
    ThreadPool pool(threads);
    EXPECT_TRUE(close_pairs(GetParam(), points.positions, points.extents, pool) == expected);
  }
}

TEST_P(Neighbours, DoNotTakeLongerBecauseOneParticleFled) {
  Random random(5);
  constexpr std::size_t kCount = 20'000;
  auto points = random_points(GetParam(), kCount, width_for(GetParam(), kCount, 250), 0, random);
  ThreadPool pool(1);
  const auto seconds = [&] {
    const auto start = std::chrono::steady_clock::now();
    close_pairs(GetParam(), points.positions, points.extents, pool);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double together = std::min(seconds(), seconds());
  std::fill_n(points.positions.begin(), GetParam(), 1e12);
  const double one_fled = std::min(seconds(), seconds());
  // All pairs would take a thousand times as long; ten is for a busy machine.
  EXPECT_LT(one_fled, 10 * together + 0.02);
}

}  // namespace
}  // namespace viscontact::particles
