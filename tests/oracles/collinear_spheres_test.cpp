#include "tests/oracles/collinear_spheres.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/oracles/bispherical/bispherical.hpp"

namespace viscontact {
namespace {

TEST(CollinearSpheres, OneAloneHasStokesDrag) {
  EXPECT_NEAR(exact_resistance({2}, {})(0, 0), 12 * std::numbers::pi, 1e-12);
}

TEST(CollinearSpheres, MatrixIsSymmetricForUnequalSpheres) {
  const auto r = exact_resistance({1, 2, 0.5}, {0.4, 1});
  EXPECT_LT((r - r.transpose()).cwiseAbs().maxCoeff(), 1e-9 * r.cwiseAbs().maxCoeff());
}

TEST(CollinearSpheres, TwoUnequalSpheresAreThoseOfTheBisphericalSeries) {
  const auto r = exact_resistance({1, 2}, {0.5});
  const double stokes = 6 * std::numbers::pi;
  EXPECT_NEAR(r(0, 0), stokes * two_sphere_drag_factor(0.5, 2, 0), 1e-9);
  EXPECT_NEAR(r(0, 0) + r(0, 1), stokes * two_sphere_drag_factor(0.5, 2, 1), 1e-9);
}

TEST(CollinearSpheres, OfThreeEqualSpheresAreThePublishedValuesOfGap1) {
  // data/reference/collinear_spheres.csv
  const auto r = exact_resistance({1, 1, 1}, {1, 1});
  EXPECT_NEAR(r(0, 0), 25.9449402918309, 1e-9);
  EXPECT_NEAR(r(0, 1), -11.8443828205962, 1e-9);
  EXPECT_NEAR(r(0, 2), -1.90784273790082, 1e-9);
  EXPECT_NEAR(r(1, 1), 32.0337197677117, 1e-9);
}

}  // namespace
}  // namespace viscontact
