#include "viscontact/suspensions/cell/strained_lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/common/random.hpp"
#include "viscontact/suspensions/values/affine_motion.hpp"

namespace viscontact::suspensions {
namespace {

using particles::cross;

constexpr Matrix kPlanar{Vector{1, 0, 0}, Vector{0, -1, 0}, Vector{0, 0, 0}};
constexpr Matrix kUniaxial{Vector{1, 0, 0}, Vector{0, -0.5, 0}, Vector{0, 0, -0.5}};

double volume_of(const Lattice& v) { return dot(cross(v[0], v[1]), v[2]); }

/// The length of the shortest vector, by all multiples of a reduced basis up to 2.
double shortest(const Lattice& v) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -2; k <= 2; ++k)
        if (i != 0 || j != 0 || k != 0)
          least = std::min(least, norm(double(i) * v[0] + double(j) * v[1] + double(k) * v[2]));
  return least;
}

/// Three rows that are unit vectors at right angles, right-handed.
Matrix random_rotation(Random& random) {
  const auto direction = [&] {
    return Vector{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  };
  Vector a = direction();
  a = (1 / norm(a)) * a;
  Vector b = cross(a, direction());
  b = (1 / norm(b)) * b;
  return {a, b, cross(a, b)};
}

/// rows^T diag(rates) rows.
Matrix with_axes(const Matrix& rows, const Vector& rates) {
  Matrix g{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) g[i][j] += rows[k][i] * rates[k] * rows[k][j];
  return g;
}

TEST(StrainedLattice, ReducedBasesAreShortAndKeepTheLattice) {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    Lattice v;
    for (auto& x : v) x = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    if (std::abs(volume_of(v)) < 0.05) continue;
    // Another basis of the same lattice.
    auto skew = v;
    skew[0] = skew[0] + 3.0 * skew[1] - 5.0 * skew[2];
    skew[2] = skew[2] - 4.0 * skew[0];
    skew[1] = skew[1] + 7.0 * skew[2];
    const auto one = reduced(v), other = reduced(skew);
    EXPECT_TRUE(are_same(v, other));
    EXPECT_NEAR(volume_of(other), std::abs(volume_of(v)), 1e-12);
    const auto least = [](const Lattice& w) {
      return std::min({norm(w[0]), norm(w[1]), norm(w[2])});
    };
    EXPECT_NEAR(least(other), shortest(one), 1e-12);
    EXPECT_NEAR(least(one), shortest(one), 1e-12);
  }
}

TEST(StrainedLattice, PlanarExtensionOfASquareIsThatOfKraynikAndReinelt) {
  const StrainedLattice lattice({3, 3, 5}, kPlanar, true);
  ASSERT_EQ(lattice.kind(), StrainedLattice::Kind::kPlanar);
  // tan(2 angle) = 2, and the lattice repeats after the strain 2 ln(golden ratio).
  EXPECT_NEAR(std::atan2(lattice.turn()[1][0], lattice.turn()[0][0]), std::atan(2.0) / 2, 1e-14);
  const double repeat = 2 * std::log((1 + std::sqrt(5.0)) / 2);
  EXPECT_TRUE(are_same(lattice.start(), lattice.at(0)));
  EXPECT_TRUE(are_same(lattice.start(), carried_lattice(kPlanar, repeat, lattice.start())));
  EXPECT_FALSE(are_same(lattice.start(), lattice.at(repeat / 2)));
  // The product of both coordinates is at least area/sqrt(5).
  double least = std::numeric_limits<double>::infinity();
  for (int k = -4000; k <= 4000; ++k) least = std::min(least, shortest(lattice.at(0.01 * k)));
  EXPECT_NEAR(least, 3 * std::sqrt(2 / std::sqrt(5.0)), 1e-4);
}

TEST(StrainedLattice, MovesAsTheFlowDoes) {
  Random random(2);
  const auto rows = random_rotation(random);
  const Matrix shearing{Vector{0.7, 1.1, 0}, Vector{0.4, -0.7, 0}, Vector{0, 0, 0}};
  for (const auto& [gradient, lengths] :
       {std::pair{kPlanar, Vector{3, 4, 5}}, std::pair{kUniaxial, Vector{4, 4, 4}},
        std::pair{with_axes(rows, {1, -0.3, -0.7}), Vector{4, 4, 4}},
        std::pair{with_axes(rows, {1, 0, -1}), Vector{3, 4, 5}},
        std::pair{shearing, Vector{3, 4, 5}}}) {
    const StrainedLattice lattice(lengths, gradient, true);
    ASSERT_NE(lattice.kind(), StrainedLattice::Kind::kAsTheBox);
    EXPECT_NEAR(volume_of(lattice.start()), lengths[0] * lengths[1] * lengths[2], 1e-12);
    auto step_by_step = reduced(lattice.start());
    for (int k = 1; k <= 40; ++k) {
      step_by_step = carried_lattice(gradient, 0.1, step_by_step);
      // Errors of single steps grow as the exponential of twice the strain, to 1e-12 here.
      EXPECT_TRUE(are_same(lattice.at(0.1 * k), step_by_step)) << k;
    }
  }
}

TEST(StrainedLattice, KeepsImagesApartForEver) {
  Random random(3);
  const Matrix rows = random_rotation(random);
  // A planar flow that turns and strains, in a box with three edges: only for strains > 0.
  const Matrix mixed{Vector{0.2, 1.3, 0}, Vector{0.4, -0.2, 0}, Vector{0, 0, 0}};
  struct Row {
    Matrix gradient;
    Vector lengths;
    double least;  // over the cube root of the volume
  };
  // The rows in a plane have the bounds of their edges at the start. The product of the three
  // coordinates of a point is at least volume/7, because it is the norm of a number of a field with
  // the discriminant 49.
  const double cubic = std::sqrt(3.0) / std::cbrt(7.0);
  for (const auto& row :
       {Row{kUniaxial, {2, 2, 2}, cubic},
        Row{with_axes({Vector{1, 0, 0}, Vector{0, 1, 0}, Vector{0, 0, 1}}, {-1, 0.5, 0.5}),
            {2, 2, 2},
            cubic},
        Row{with_axes(rows, {1, -0.8, -0.2}), {2, 2, 2}, cubic}, Row{kPlanar, {2, 3, 2.4}, 0.7},
        Row{mixed, {2, 3, 2.4}, 0.6}}) {
    const StrainedLattice lattice(row.lengths, row.gradient, true);
    const double unit = std::cbrt(row.lengths[0] * row.lengths[1] * row.lengths[2]);
    double height = std::numeric_limits<double>::infinity(), least = height;
    for (int k = 0; k <= 20000; ++k) {
      const auto now = lattice.at(0.01 * k);
      least = std::min(least, shortest(now));
      height = std::min(height, std::ranges::min(heights_of(now)));
    }
    EXPECT_GE(least, (row.least - 1e-9) * unit);
    EXPECT_NEAR(height, lattice.least_height(), 0.01 * unit);
  }
}

TEST(StrainedLattice, OtherFlowsLeaveTheBoxAsItIs) {
  for (const Matrix& gradient :
       {Matrix{}, Matrix{Vector{0, 1, 0}, Vector{}, Vector{}},
        Matrix{Vector{0, 1, 1}, Vector{}, Vector{}},
        Matrix{Vector{0, 1, 0}, Vector{-2, 0, 0}, Vector{}},
        Matrix{Vector{1, 0, 0.1}, Vector{0, -0.5, 0}, Vector{0, 0, -0.5}}}) {
    const StrainedLattice lattice({2, 3, 4}, gradient, true);
    EXPECT_EQ(lattice.kind(), StrainedLattice::Kind::kAsTheBox);
    EXPECT_EQ(lattice.start(), (Lattice{Vector{2, 0, 0}, Vector{0, 3, 0}, Vector{0, 0, 4}}));
  }
  EXPECT_EQ(StrainedLattice({2, 3, 4}, kPlanar, false).kind(), StrainedLattice::Kind::kAsTheBox);
}

}  // namespace
}  // namespace viscontact::suspensions
