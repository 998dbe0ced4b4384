// Distances to discs and ellipses against closed forms and a search over many points of the
// outline. Lengths are in one unit.
#include "viscontact/particles/setting/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace viscontact::particles {
namespace {

using Point = std::array<double, 2>;
using std::numbers::pi;

Outline ellipse(const Point& centre, const Point& semi_axes, double angle) {
  return {centre, std::max(semi_axes[0], semi_axes[1]), semi_axes, angle};
}

double distance_by_search(const Outline& outline, const Point& x) {
  constexpr int kPoints = 100'000;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kPoints; ++i) {
    const auto at = outline.at(2 * pi * i / kPoints);
    least = std::min(least, std::hypot(x[0] - at[0], x[1] - at[1]));
  }
  return least;
}

// Near the point the distance of a smooth curve grows with the square of the parameter, so that the
// search errs by 1e-9 of the semi-axis.
TEST(Outline, DistanceToAnEllipseIsThatToItsNearestPoint) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-3, 3), axis(0.05, 2);
  for (int n = 0; n < 40; ++n) {
    const auto e =
        ellipse({number(random), number(random)}, {axis(random), axis(random)}, 2 * number(random));
    const Point x = {number(random), number(random)};
    const double found = distance_to(e, x);
    EXPECT_NEAR(std::abs(found), distance_by_search(e, x), 1e-7);
    const double c = std::cos(e.angle), s = std::sin(e.angle);
    const double dx = x[0] - e.centre[0], dy = x[1] - e.centre[1];
    EXPECT_EQ(found < 0, std::hypot((c * dx + s * dy) / e.semi_axes[0],
                                    (c * dy - s * dx) / e.semi_axes[1]) < 1);
  }
}

TEST(Outline, DistancesOnTheAxesAreExact) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto e = ellipse({0, 0}, {2 * unit, 1 * unit}, 0);
    EXPECT_NEAR(distance_to(e, {5 * unit, 0}), 3 * unit, 1e-14 * unit);
    EXPECT_NEAR(distance_to(e, {0, 5 * unit}), 4 * unit, 1e-14 * unit);
    EXPECT_NEAR(distance_to(e, {0, 0}), -1 * unit, 1e-14 * unit);
    // Within the evolute the nearest point of the long axis is beside the axis: b sqrt(1 - x^2/(a^2
    // - b^2)).
    EXPECT_NEAR(distance_to(e, {unit, 0}), -unit * std::sqrt(1 - 1 / 3.0), 1e-14 * unit);
  }
  const auto circle = ellipse({1, 2}, {3, 3}, 0.7);
  EXPECT_TRUE(circle.is_circle());
  EXPECT_NEAR(distance_to(circle, {1, 7}), 2, 1e-15);
}

TEST(Outline, GapToALineIsThatOfTheSupportFunction) {
  const PlanePosition line{{0, -1, 0}, {0, 1, 0}};
  for (const double angle : {0.0, 0.4, 1.2, -2.9}) {
    const double support = std::hypot(2 * std::sin(angle), 0.3 * std::cos(angle));
    EXPECT_NEAR(gap(line, ellipse({5, 3}, {2, 0.3}, angle)), 4 - support, 1e-14);
  }
}

TEST(Outline, GapOfTwoIsSymmetricAndIndependentOfTheScene) {
  const auto first = ellipse({0, 0}, {2, 0.5}, 0.3), second = ellipse({2, 2.5}, {0.4, 1.5}, 1.1);
  const double here = gap(first, second);
  EXPECT_GT(here, 0);
  EXPECT_NEAR(gap(second, first), here, 1e-12);
  // The whole scene turned by an angle, and an ellipse named by its other semi-axis.
  const double turn = 2.2, c = std::cos(turn), s = std::sin(turn);
  EXPECT_NEAR(gap(ellipse({0, 0}, {0.5, 2}, 0.3 + turn + pi / 2),
                  ellipse({2 * c - 2.5 * s, 2 * s + 2.5 * c}, {0.4, 1.5}, 1.1 + turn)),
              here, 1e-12);
  // To a disc beside the tip, and to the tip of another one.
  EXPECT_NEAR(gap(first, Outline{{0, 0}, 0.1}), -0.6, 1e-12);
  EXPECT_NEAR(gap(ellipse({0, 0}, {2, 1}, 0), ellipse({5, 0}, {1, 2}, pi / 2)), 1, 1e-12);
  const PlanePosition wall{{0, 0, 0}, {}, 4};
  EXPECT_NEAR(gap(wall, ellipse({0, 0}, {3, 1}, 0.9)), 1, 1e-14);
}

Outline plate(const Point& centre, double half_length, double end_radius, double angle) {
  return {centre, half_length, {half_length, end_radius}, angle, true};
}

/// Half of the sum of what a function of two neighbouring points of an outline gives: with the
/// cross product of both twice the area.
template <class Function>
double around(const Outline& outline, const Function& function) {
  constexpr int kPoints = 100'000;
  double sum = 0;
  for (int i = 0; i < kPoints; ++i)
    sum += function(outline.at(2 * pi * i / kPoints), outline.at(2 * pi * (i + 1) / kPoints));
  return sum / 2;
}

TEST(Plate, IsTheSetOfAllPointsAroundItsSpine) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-3, 3);
  for (int n = 0; n < 20; ++n) {
    const auto p = plate({number(random), number(random)}, 2, 0.3, 2 * number(random));
    const Point x = {number(random), number(random)};
    EXPECT_NEAR(std::abs(distance_to(p, x)), distance_by_search(p, x), 1e-4);
    for (int i = 0; i < 50; ++i) EXPECT_NEAR(distance_to(p, p.at(0.13 * i)), 0, 1e-14);
  }
  // Points lie evenly and counter-clockwise, from the end along the angle on.
  const auto p = plate({1, 2}, 2, 0.3, 0);
  EXPECT_NEAR(p.at(0)[0], 3, 1e-15);
  EXPECT_NEAR(p.at(0)[1], 2, 1e-15);
  EXPECT_NEAR(p.at(pi / 2)[1], 2.3, 1e-15);
  EXPECT_NEAR(p.at(pi)[0], -1, 1e-14);
  EXPECT_NEAR(p.length(), 4 * 1.7 + 2 * pi * 0.3, 1e-14);
  EXPECT_NEAR(p.speed_at(0.4), p.length() / (2 * pi), 1e-15);
}

TEST(Plate, HasTheAreaAndMomentOfInertiaOfItsOutline) {
  const auto p = plate({0, 0}, 1.5, 0.4, 0.7);
  const auto twice_area = [](const Point& a, const Point& b) { return a[0] * b[1] - a[1] * b[0]; };
  const double area = around(p, twice_area);
  EXPECT_NEAR(size_of_plate({1.5, 0.4}), area, 1e-7);
  // The polar moment of the triangle between two points and the centre.
  const double moment = around(p, [&](const Point& a, const Point& b) {
    const double squares =
        a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1] + a[0] * b[0] + a[1] * b[1];
    return twice_area(a, b) * squares / 6;
  });
  EXPECT_NEAR(homogeneous_inertia_of_plate(area, {1.5, 0.4}), moment, 1e-7);
  // Without sides it is a disc.
  EXPECT_NEAR(homogeneous_inertia_of_plate(3, {0.4, 0.4}), homogeneous_inertia(2, 3, 0.4), 1e-15);
}

TEST(Plate, GapsAreThoseOfTheSpines) {
  const auto flat = plate({0, 0}, 2, 0.25, 0);
  // Beside the side, and before the end.
  EXPECT_NEAR(gap(flat, plate({1, 2}, 1, 0.5, pi / 2)), 2 - 0.5 - 0.5 - 0.25, 1e-14);
  EXPECT_NEAR(gap(flat, plate({4, 0}, 1, 0.5, 0)), 1, 1e-14);
  EXPECT_NEAR(gap(flat, Outline{{1, 2}, 0.5}), 1.25, 1e-14);
  EXPECT_LT(gap(flat, plate({0.3, 0.1}, 2, 0.25, 1)), -0.5 + 1e-14);
  EXPECT_NEAR(gap(flat, ellipse({0.5, 3}, {1, 2}, 0)), 0.75, 1e-8);
  const PlanePosition floor{{0, -1, 0}, {0, 1, 0}};
  EXPECT_NEAR(gap(floor, plate({0, 0}, 1, 0.1, 0.5)), 1 - 0.9 * std::sin(0.5) - 0.1, 1e-14);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-2, 2);
  for (int n = 0; n < 20; ++n) {
    const auto one = plate({number(random), 0}, 1, 0.2, number(random));
    const auto other = plate({number(random), 2.5}, 1.2, 0.1, number(random));
    double least = std::numeric_limits<double>::infinity();
    constexpr int kPoints = 20'000;
    for (int i = 0; i < kPoints; ++i)
      least = std::min(least, distance_to(other, one.at(2 * pi * i / kPoints)));
    EXPECT_NEAR(gap(one, other), least, 1e-4);
    EXPECT_NEAR(gap(one, other), gap(other, one), 1e-14);
  }
}

TEST(Outline, TipsAreCurvedMost) {
  const auto e = ellipse({0, 0}, {2, 1}, 0.5);
  EXPECT_NEAR(e.curvature_radius_at(0), 0.5, 1e-15);
  EXPECT_NEAR(e.curvature_radius_at(pi / 2), 4, 1e-14);
  EXPECT_NEAR(e.speed_at(pi / 2), 2, 1e-15);
}

}  // namespace
}  // namespace viscontact::particles
