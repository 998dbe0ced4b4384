// Fits of pairs in place of the tables of resistances.
#include "viscontact/motions/fitted_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::motions {
namespace {

using lubrication::kPairComponents;
using lubrication::kSphereComponents;
using lubrication::PairMatrix;

const std::filesystem::path kFits = VISCONTACT_SOURCE_FOLDER "/data/fits";
constexpr double kInfinity = std::numeric_limits<double>::infinity();

FittedPairs read(const std::string& name) { return read_fitted_pairs(fit_files_in(kFits / name)); }

/// The largest difference of entries over the roots of the diagonal ones.
double largest_difference(const PairMatrix& a, const PairMatrix& b) {
  double largest = 0;
  const auto at = [](const PairMatrix& m, std::size_t i, std::size_t j) {
    return m[i * kPairComponents + j];
  };
  for (std::size_t i = 0; i < kPairComponents; ++i)
    for (std::size_t j = 0; j < kPairComponents; ++j) {
      const double size = std::sqrt(at(b, i, i) * at(b, j, j));
      if (size > 0) largest = std::max(largest, std::abs(at(a, i, j) - at(b, i, j)) / size);
      if (size == 0) {
        EXPECT_EQ(at(a, i, j), at(b, i, j));
      }
    }
  return largest;
}

TEST(FittedPairs, HaveTheEntriesOfTheExactPair) {
  // Fits of strained pairs have errors of some 1e-6 of their entries.
  const auto plane = read("pairs/strained_plane.json");
  const auto spheres = read("pairs/strained_equal_spheres.json");
  for (const double q : {1e-3, 0.02, 0.3, 2.0})
    for (const double radius : {1.0, 0.2}) {
      const double mu = 5;
      EXPECT_LT(largest_difference(plane.resistance(radius, kInfinity, q * radius, mu),
                                   lubrication::pair_resistance(radius, kInfinity, q * radius, mu)),
                1e-5);
      EXPECT_LT(largest_difference(plane.resistance(kInfinity, radius, q * radius, mu),
                                   lubrication::pair_resistance(kInfinity, radius, q * radius, mu)),
                1e-5);
      EXPECT_LT(largest_difference(spheres.resistance(radius, radius, q * radius, mu),
                                   lubrication::pair_resistance(radius, radius, q * radius, mu)),
                1e-5);
    }
}

TEST(FittedPairs, AreTheTablesAtOtherRatiosAndGaps) {
  const auto spheres = read("pairs/strained_equal_spheres.json");
  const auto exact = [](double other, double gap) {
    return lubrication::pair_resistance(1, other, gap, 1);
  };
  EXPECT_EQ(spheres.resistance(1, 1.1, 0.1, 1), exact(1.1, 0.1));
  EXPECT_EQ(spheres.resistance(1, kInfinity, 0.1, 1), exact(kInfinity, 0.1));
  EXPECT_EQ(spheres.resistance(1, 1, 9e-4, 1), exact(1, 9e-4));
  EXPECT_EQ(spheres.resistance(1, 1, 2.1, 1), exact(1, 2.1));
  EXPECT_NE(spheres.resistance(1, 1, 0.1, 1), exact(1, 0.1));
}

TEST(FittedPairs, OfTheSqueezingForceReplaceIt) {
  const auto plane = read("lecture.json");
  const lubrication::LubricationForce force(lubrication::read_fit(kFits / "lecture.json"));
  auto matrix = plane.resistance(kInfinity, 1, 0.02, 3);
  const std::size_t squeeze = (kSphereComponents + 2) * (kPairComponents + 1);
  EXPECT_DOUBLE_EQ(matrix[squeeze], force.resistance(0.02));
  // Nothing else is replaced.
  const auto exact = lubrication::pair_resistance(kInfinity, 1, 0.02, 3);
  matrix[squeeze] = exact[squeeze];
  EXPECT_EQ(matrix, exact);
}

TEST(FittedPairs, RefuseFitsThatDoNotMakeAPair) {
  const auto read_all = [](const std::vector<std::string>& names) {
    std::vector<std::filesystem::path> files;
    for (const auto& name : names) files.push_back(kFits / name);
    return read_fitted_pairs(files);
  };
  EXPECT_NO_THROW(read_all({"pairs/plane.json", "pairs/strained_equal_spheres.json"}));
  EXPECT_THROW(read_all({"pairs/equal_spheres.json"}), Error);          // without stresslets
  EXPECT_THROW(read_all({"pairs/free_surface.json"}), Error);           // no plane at rest
  EXPECT_THROW(read_all({"pairs/plane.json", "lecture.json"}), Error);  // of one pair
  EXPECT_THROW(fit_files_in(kFits / "none"), Error);
  EXPECT_EQ(fit_files_in(kFits / "pairs").size(), 7U);
}

TEST(FittedPairs, OfTwoRadiiNeedBothFits) {
  auto fit = read_pair_fit(kFits / "pairs/strained_equal_spheres.json");
  fit.geometry = "sphere, radius 2, velocity_ratio 0";
  EXPECT_THROW(FittedPairs(std::span(&fit, 1)), Error);
  auto turned = fit;
  turned.geometry = "sphere, radius 0.5, velocity_ratio 0";
  const FittedPairs pairs(std::vector{fit, turned});
  // Each sphere has the entries of its own fit, here those of equal spheres.
  const auto matrix = pairs.resistance(3, 6, 0.1, 1);
  EXPECT_DOUBLE_EQ(matrix[2 * kPairComponents + 2],
                   3 * entry_value(fit, PairEntry::kSqueeze, 0.1 / 3));
  const std::size_t second = kSphereComponents + 2;
  EXPECT_DOUBLE_EQ(matrix[second * kPairComponents + second],
                   6 * entry_value(fit, PairEntry::kSqueeze, 0.1 / 6));
}

}  // namespace
}  // namespace viscontact::motions
