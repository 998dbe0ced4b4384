// Pair distributions of places whose pairs are counted by hand.
#include "viscontact/particle_runs/run/pair_distribution.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace viscontact::particles {
namespace {

/// Two spheres of the radii 1 and 2 in a cubic cell of the period 30, sheared by `offset`.
struct TwoSpheres {
  explicit TwoSpheres(const Vector& apart, double offset = 0) {
    BoxDomain box;
    box.to = {30, 30, 30};
    box.periodic = {true, true, true};
    c.setting.domain = box;
    c.setting.lubrication.emplace().gradient[0][1] = 1;
    playback.dimension = 3;
    playback.radii = {1, 2};
    playback.cell = cell_of(c.setting.domain);
    Frame frame;
    frame.positions = {20, 28, 5};
    for (std::size_t d = 0; d < 3; ++d)
      frame.positions.push_back(frame.positions[d] + static_cast<float>(apart[d]));
    frame.offset = offset;
    playback.frames.push_back(frame);
  }
  std::vector<PairDistributionRow> rows() const { return pair_distribution(c, playback); }
  ParticlesCase c;
  Playback playback;
};

/// The one row with a pair; the others must be empty.
PairDistributionRow only_row(const std::vector<PairDistributionRow>& rows) {
  PairDistributionRow found;
  int count = 0;
  for (const auto& row : rows)
    if (row.all > 0) {
      found = row;
      ++count;
    }
  EXPECT_EQ(count, 1);
  return found;
}

TEST(PairDistribution, IsTheNumberOfPairsOverThatWithoutOrder) {
  const auto row = only_row(TwoSpheres({2.0, -2.5, 0.1}).rows());  // |.| = 3.203, over 3: 1.0677
  EXPECT_DOUBLE_EQ(row.distance, 1.07);
  const double shell = 4 * std::numbers::pi / 3 * 27 * (1.08 * 1.08 * 1.08 - 1.06 * 1.06 * 1.06);
  EXPECT_NEAR(row.all, 27000 / shell, 1e-9 * row.all);
  // x and y have opposite signs, where a shear of a positive rate compresses.
  EXPECT_DOUBLE_EQ(row.compression, 2 * row.all);
  EXPECT_EQ(row.extension, 0);
}

TEST(PairDistribution, FindsImagesOfAShearedCell) {
  // The image across y is displaced by 10: (-8, -27) and (10, 30) are (2, 3).
  const auto row = only_row(TwoSpheres({-8, -27, 0}, 10).rows());
  EXPECT_DOUBLE_EQ(row.distance, 1.21);  // 13^(1/2)/3 = 1.2019
  EXPECT_EQ(row.extension, 2 * row.all);
}

TEST(PairDistribution, FindsImagesOfAStrainedCell) {
  // The image by the first and the third vector is at (2, 1, 2), 3 away and within the first bin.
  TwoSpheres spheres({-20, -9, -28});
  spheres.c.setting.lubrication->gradient = {Vector{1, 0, 0}, Vector{0, -0.5, 0},
                                             Vector{0, 0, -0.5}};
  spheres.playback.frames[0].offset = {};
  spheres.playback.frames[0].periods = {Vector{22, 10, 0}, Vector{-9, 28, 0}, Vector{0, 0, 30}};
  spheres.playback.frames[0].positions = {8, 8, 20, -12, -1, -8};
  const auto row = only_row(spheres.rows());
  EXPECT_DOUBLE_EQ(row.distance, 1.01);
  // x E x = 4 - 0.5 - 2 > 0. The flow extends where cos^2 > 1/3.
  EXPECT_EQ(row.compression, 0);
  EXPECT_NEAR(row.extension, row.all / (1 - 1 / std::sqrt(3.0)), 1e-3 * row.extension);
}

TEST(PairDistribution, IsEmptyWithoutABox) {
  TwoSpheres spheres({3.5, 0, 0});
  spheres.c.setting.domain = {};
  EXPECT_TRUE(spheres.rows().empty());
}

}  // namespace
}  // namespace viscontact::particles
