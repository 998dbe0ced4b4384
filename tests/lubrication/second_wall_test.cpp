// The wall opposite the neighbour: where it is, and the drag up to it.
#include "viscontact/lubrication/second_wall.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/scaling.hpp"

namespace viscontact::lubrication {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kRounding = 1e-14;

TEST(SecondWall, IsWhereContainersAndCavitiesEnd) {
  const auto largest = [](const char* geometry, const char* container, double radius) {
    const auto wall = second_wall(geometry, container, radius);
    return wall ? wall->largest_gap : 0;
  };
  const char* cylinder = "closed cylinder, radius 9, height 12";
  EXPECT_EQ(largest("plane", cylinder, 2), 8);
  EXPECT_EQ(largest("free_surface", cylinder, 2), 8);
  EXPECT_EQ(largest("rough_plane, amplitude 0.1, wavelength 1", cylinder, 2), 8);
  EXPECT_EQ(largest("sphere, radius 2, velocity_ratio 0", cylinder, 2), 4);
  EXPECT_EQ(largest("sphere, radius 2.5, velocity_ratio 0", cylinder, 2), 2);
  EXPECT_EQ(largest("cavity, radius 5", "none", 2), 6);
  EXPECT_EQ(largest("plane", "unbounded", 2), 0);
  EXPECT_EQ(largest("plane", "", 2), 0);
  EXPECT_EQ(largest("plane", cylinder, 7), 0);
  EXPECT_EQ(largest("a wall of my own", cylinder, 2), 0);
}

Fit fit_in(const char* geometry, const char* container, double largest_fitted) {
  Fit fit;
  fit.basis = kOwnTerms;
  fit.reference_velocity = -1;
  fit.viscosity = 0.7;
  fit.radius = 2;
  fit.gap_interval = {0.01, largest_fitted};
  const double k = 6 * kPi * 0.7 * 4;
  fit.terms = {{"1/q", k, 0, false}, {"1", k, 0, false}};
  fit.geometry = geometry;
  fit.container = container;
  return fit;
}

class DragUpToAWall : public ::testing::TestWithParam<Fit> {};

TEST_P(DragUpToAWall, IsSingularThereAndContinuousAndHasItsPrimitive) {
  const Fit fit = GetParam();
  const LubricationForce force(fit,
                               {BelowInterval::kLubricationLimit, AboveInterval::kStokesLimit});
  const auto wall = second_wall_of(fit).value();
  const double far = wall.largest_gap, k = wall.leading_factor * 6 * kPi * 0.7 * 4;
  EXPECT_EQ(force.largest_gap(), far);
  EXPECT_EQ(force.interval()[1], far);
  const double end = fit.gap_interval[1];
  // Across the end of the interval the drag changes by its slope times the distance, 1e-9.
  EXPECT_NEAR(force.resistance(end * (1 + 1e-9)) / force.resistance(end), 1, 1e-7);
  // The rest of R is bounded: 1e-9 of the singular term at the distance 1e-9.
  const double near = far * (1 - 1e-9);
  EXPECT_NEAR(force.resistance(near) * (far - near) / k, 1, 1e-7);
  for (const double gap : {0.3 * end, end, end + 0.3 * (far - end), far - 0.01, far - 1e-4}) {
    // Differences of second order in a small part of the distance to the wall.
    const double step = 1e-4 * std::min(gap, far - gap);
    if (gap == end) continue;
    const double slope = (force.impulse(gap + step) - force.impulse(gap - step)) / (2 * step);
    EXPECT_NEAR(slope / force.resistance(gap), 1, 1e-6) << gap;
    const double curve = (force.resistance(gap + step) - force.resistance(gap - step)) / (2 * step);
    EXPECT_NEAR(curve * gap, force.resistance_log_slope(gap),
                1e-6 * std::abs(force.resistance_log_slope(gap)))
        << gap;
    // Gamma is a logarithm of the distance to the wall, whose rounding error is that of the gap.
    EXPECT_NEAR(force.gap_of_impulse(force.impulse(gap)), gap, 1e-13 * far) << gap;
  }
  EXPECT_LT(force.gap_of_impulse(1e6 * k), far);
  EXPECT_GT(force.gap_of_impulse(1e6 * k), far * (1 - kRounding));
  for (const double gap : {far, 62.7, HUGE_VAL}) EXPECT_THROW(force.resistance(gap), Error) << gap;
}

INSTANTIATE_TEST_SUITE_P(
    Rooms, DragUpToAWall,
    ::testing::Values(fit_in("plane", "closed cylinder, radius 9, height 12", 2),
                      fit_in("plane", "closed cylinder, radius 9, height 4.5", 0.3),
                      fit_in("free_surface", "closed cylinder, radius 9, height 12", 7.5),
                      fit_in("sphere, radius 1, velocity_ratio 0",
                             "closed cylinder, radius 9, height 20", 3),
                      fit_in("cavity, radius 5", "none", 3)));

TEST(DragUpToAWallOfOtherUnits, IsScaled) {
  const Fit fit = [] {
    Fit f = fit_in("plane", "closed cylinder, radius 9, height 12", 7);
    f.terms.push_back({"1/(L-q)", 40, 0, false});
    f.terms.push_back({"ln(L-q)", -3, 0, false});
    return f;
  }();
  const OutsideInterval limits{BelowInterval::kLubricationLimit, AboveInterval::kStokesLimit};
  const LubricationForce force(fit, limits);
  for (const double unit : {1e-6, 3.0, 1e4}) {
    const LubricationForce scaled(scaled_to(fit, 0.7, 2 * unit), limits);
    EXPECT_NEAR(scaled.largest_gap() / unit, 8, 8 * kRounding);
    for (const double gap : {1e-3, 0.5, 4.0, 6.9, 7.9})
      EXPECT_NEAR(scaled.resistance(gap * unit) / (force.resistance(gap) * unit), 1, 1e-12) << gap;
  }
}

TEST(DragUpToAWallThatIsNotThere, IsRefused) {
  Fit fit = fit_in("plane", "unbounded", 7);
  fit.terms.push_back({"1/(L-q)", 40, 0, false});
  EXPECT_THROW(LubricationForce{fit}, Error);
  const LubricationForce bounded(fit_in("plane", "closed cylinder, radius 9, height 12", 2));
  EXPECT_THAT(bad_input([&] { (void)bounded.resistance(5); }), Names("gap 8"));
}

}  // namespace
}  // namespace viscontact::lubrication
