// The ends of what a geometry may be told, and geometries that are equal or nearly so in other
// words.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/freefem_axi/accuracy/exact_rows.hpp"
#include "tests/oracles/bispherical/bispherical.hpp"
#include "viscontact/freefem_axi/tabulation.hpp"

namespace viscontact::freefem_axi {
namespace {

constexpr double kAccuracy = 1e-5;

/// Drag factor with its absolute error by the row's own estimate.
struct Drag {
  double factor = 0, error = 0;
};

/// Where no exact one is known.
Drag drag(const std::string& geometry, double gap, std::vector<double> parameters,
          double accuracy = kAccuracy) {
  const auto solved =
      solve(default_freefem(), exact_row(geometry, gap, std::move(parameters), accuracy, 1));
  EXPECT_TRUE(solved.says_reached()) << solved.in_words();
  return {solved.answer.force_factor,
          solved.answer.force_factor * solved.answer.relative_error_estimate};
}

/// That the asked accuracy is reached, and that it is said.
void expect_reached(const ExactRow& row) {
  const auto solved = solve(default_freefem(), row);
  EXPECT_TRUE(solved.says_reached()) << solved.in_words();
  EXPECT_LE(solved.error(), row.tabulation.relative_accuracy) << solved.in_words();
}

TEST(SmallestGap, ReachesTheUsualAccuracy) {
  constexpr double kGap = 1e-6;
  expect_reached(exact_row("plane", kGap, {}, kAccuracy, bispherical_plane_factor(kGap)));
  expect_reached(exact_row("free_surface", kGap, {}, kAccuracy, free_surface_drag_factor(kGap)));
  expect_reached(exact_row("cavity", kGap, {2}, kAccuracy, cavity_drag_factor(kGap, 2)));
}

TEST(LargestGap, ReachesTheUsualAccuracy) {
  constexpr double kGap = 10;
  expect_reached(exact_row("plane", kGap, {}, kAccuracy, bispherical_plane_factor(kGap)));
}

TEST(LargestContainer, ReachesTheUsualAccuracy) {
  // The most that a case may ask for; so wide, the drag is that in a half-space.
  for (const double gap : {1e-6, 0.5}) {
    auto row = exact_row("plane", gap, {}, kAccuracy, bispherical_plane_factor(gap));
    row.tabulation.container = Container{2e5, 2e5};
    expect_reached(row);
  }
}

TEST(ContainerThatIsTooLarge, IsSaidInPlaceOfAnAssertionOfFreeFem) {
  auto row = exact_row("plane", 0.1, {}, kAccuracy, bispherical_plane_factor(0.1));
  row.tabulation.container = Container{1e6, 1e6};
  EXPECT_THAT(failure(ErrorKind::kExternalProgram,
                      [&] { (void)solve_row(default_freefem(), row.tabulation, 0.1, -1); }),
              Names("0.1", "container"));
}

TEST(ContainerThatIsTooLarge, ForTheFinerMeshesLeavesTheResultOfTheFirstOnes) {
  // 2e-7 would take edges that FreeFEM cannot make in so large a domain.
  constexpr double kGap = 0.3, kAsked = 2e-7;
  auto row = exact_row("plane", kGap, {}, kAsked, bispherical_plane_factor(kGap));
  row.tabulation.container = Container{2e5, 2e5};
  const auto solved = solve(default_freefem(), row);
  EXPECT_GT(solved.answer.relative_error_estimate, kAsked);
  EXPECT_LE(solved.error(), solved.answer.relative_error_estimate) << solved.in_words();
}

class SecondSphere : public ::testing::TestWithParam<double> {};

// Near contact; error_estimate_test.cpp draws other gaps and radii.
TEST_P(SecondSphere, MayBeAHundredTimesSmallerOrLarger) {
  const double radius = GetParam(), gap = 1e-3 * std::min(1.0, radius);
  expect_reached(
      exact_row("sphere", gap, {radius, 0, 0}, kAccuracy, two_sphere_drag_factor(gap, radius, 0)));
}

INSTANTIATE_TEST_SUITE_P(OfRadius, SecondSphere, ::testing::Values(0.01, 100.0),
                         [](const auto& test) { return test.param < 1 ? "Small" : "Large"; });

TEST(SecondSphere, TendsToAPlaneAsItGrows) {
  constexpr double kGap = 0.1, kRadius = 100;
  // The difference is 1.6 % of the drag, so that an error of 0.1 % leaves it in its bounds.
  const auto sphere = drag("sphere", kGap, {kRadius, 0, 0}, 1e-3);
  // The film's resistance is (1 + 1/R)^-2 of the plane's, a difference of 2/R; the flow around,
  // some 10 % of the drag here, differs less: 1.63/R at R = 100.
  const double difference = 1 - sphere.factor / bispherical_plane_factor(kGap);
  EXPECT_GT(difference * kRadius, 1.4);
  EXPECT_LT(difference * kRadius, 2.0);
}

TEST(TightCavity, IsExactCloseToConcentricAndNearContact) {
  constexpr double kRadius = 1.05;
  // The largest gap as a case file would say it, past the centre by a rounding error or not.
  expect_reached(
      exact_row("cavity", 0.05, {kRadius}, kAccuracy, concentric_cavity_drag_factor(kRadius)));
  expect_reached(
      exact_row("cavity", 1e-3, {kRadius}, kAccuracy, cavity_drag_factor(1e-3, kRadius)));
}

TEST(TightCylinder, HasTheDragOfASphereInALongTube) {
  constexpr double kTube = 1.05;
  auto row = exact_row("plane", 3, {}, 1e-4, 1);
  row.tabulation.container = Container{kTube, 8};
  const auto solved = solve(default_freefem(), row);
  EXPECT_TRUE(solved.says_reached()) << solved.in_words();
  // Bungay & Brenner 1973 (Int. J. Multiphase Flow 1, 25): a sphere that settles on the axis of a
  // closed tube, x = r/R.
  const double x = 1 / kTube;
  const double film = 2.25 * std::pow(std::numbers::pi, 2) * std::numbers::sqrt2 *
                      std::pow(1 - x, -2.5) *
                      (1 - 73. / 60 * (1 - x) + 77293. / 50400 * (1 - x) * (1 - x));
  const double tube = (film - 22.5083 - 5.6117 * x - 0.3363 * x * x - 1.216 * std::pow(x, 3) +
                       1.647 * std::pow(x, 4)) /
                      (6 * std::numbers::pi);
  // Their formula joins the film's expansion to the wide tube's; ends 3 radii away do not matter
  // (the flow in a tube decays like exp(-4 z/R)).
  EXPECT_NEAR(solved.answer.force_factor / tube, 1, 0.01);
}

TEST(RoughPlane, IsBetweenThePlaneOfItsCrestsAndThatOfItsTroughs) {
  // More fluid dissipates less (Hill & Power 1956): strictly between, beyond the estimated error.
  constexpr double kGap = 0.1, kAmplitude = 1e-3;
  const auto rough = drag("rough_plane", kGap, {kAmplitude, 0.5});
  EXPECT_LT(rough.factor + rough.error, bispherical_plane_factor(kGap));
  EXPECT_GT(rough.factor - rough.error, bispherical_plane_factor(kGap + 2 * kAmplitude));
}

TEST(RoughPlane, TendsToThePlaneAsItsRipplesVanish) {
  constexpr double kGap = 0.1;
  const auto rough = drag("rough_plane", kGap, {1e-9, 0.5});
  // Planes 1e-9 and less apart: a relative difference of 2e-8 at most.
  EXPECT_NEAR(rough.factor, bispherical_plane_factor(kGap), rough.error + 2e-8 * rough.factor);
}

TEST(RoughPlane, WithLongRipplesFallsFromTheCrestToTheDepthOfItsAmplitude) {
  // One ripple is longer than the part with ripples, which ends 2 radii from the axis. From the
  // crest on the axis the floor falls to the flat part at the depth amplitude/(1 + steepness +
  // ...).
  constexpr double kGap = 0.1, kAmplitude = 1e-3;
  for (const double wavelength : {70.0, 200.0}) {
    const auto rough = drag("rough_plane", kGap, {kAmplitude, wavelength});
    EXPECT_LT(rough.factor + rough.error, bispherical_plane_factor(kGap));
    EXPECT_GT(rough.factor - rough.error, bispherical_plane_factor(kGap + kAmplitude));
  }
}

TEST(RoughPlane, NearContactIsFeltThroughItsCrest) {
  // A gap far below the amplitude, with a film over the crest on the axis alone.
  constexpr double kAmplitude = 0.02, kGap = 1e-3;
  const auto rough = drag("rough_plane", kGap, {kAmplitude, 0.5});
  EXPECT_LT(rough.factor + rough.error, bispherical_plane_factor(kGap));
  EXPECT_GT(rough.factor - rough.error, bispherical_plane_factor(kGap + 2 * kAmplitude));
  // The crest is a cap of curvature (2 pi / wavelength)^2 amplitude = 3.16: its film resists like
  // (1 + 3.16)^-2 r/q, and what is around adds some 10 of 58.
  EXPECT_GT(rough.factor,
            std::pow(1 + kAmplitude * std::pow(2 * std::numbers::pi / 0.5, 2), -2) / kGap);
}

}  // namespace
}  // namespace viscontact::freefem_axi
