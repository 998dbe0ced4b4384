// Shapes against sums over many points of their outlines. Lengths are in one unit.
#include "viscontact/particles/shapes/shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace viscontact::particles {
namespace {

using std::numbers::pi;

std::vector<Shape> shapes() {
  return {Shape::disc(0.7),        Shape::sphere(0.7),       Shape::ellipse(2, 0.5),
          Shape::ellipse(0.5, 2),  Shape::ellipse(1.3, 1.3), Shape::ellipse(10, 0.5),
          Shape::plate(1.5, 0.25), Shape::plate(1.001, 1)};
}

// The corners of the integrands of plates, where a side meets an end, make errors of 1/kPoints^2 of
// the value; smooth outlines have rounding errors only.
constexpr int kPoints = 200'000;
constexpr double kError = 1e-9;

struct Sums {
  double length = 0, area = 0, second_moment = 0;
};

Sums sums_of(const Shape& shape) {
  Sums sums;
  for (int i = 0; i < kPoints; ++i) {
    const auto at = shape.at(2 * pi * (i + 0.5) / kPoints);
    const double ds = at.speed * 2 * pi / kPoints, height = dot(at.point, at.normal);
    sums.length += ds;
    sums.area += height * ds / 2;
    sums.second_moment += dot(at.point, at.point) * height * ds / 4;  // div (r^2 x) = 4 r^2
  }
  return sums;
}

TEST(Shape, SumsOverTheOutlineGiveLengthAreaAndInertia) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name());
    const Sums sums = sums_of(shape);
    EXPECT_NEAR(shape.perimeter(), sums.length, kError * sums.length);
    if (shape.kind() == ShapeKind::kSphere) continue;
    EXPECT_NEAR(shape.measure(), sums.area, kError * sums.area);
    const double mass = 3;
    EXPECT_NEAR(shape.inertia(mass), mass * sums.second_moment / sums.area,
                kError * shape.inertia(mass));
  }
  const auto sphere = Shape::sphere(2);
  EXPECT_DOUBLE_EQ(sphere.measure(), 32 * pi / 3);
  EXPECT_DOUBLE_EQ(sphere.inertia(3), 0.4 * 3 * 4);
}

// 4 a E(1 - b^2/a^2) from mpmath 1.3 with 30 digits. std::comp_ellint_2 has errors of 2e-13.
TEST(Shape, TheOutlineOfAnEllipseIsAnEllipticIntegral) {
  const std::vector<Vector2> known = {{1, 6.2831853071795865},
                                      {1.1, 6.6010850941376963},
                                      {3, 13.364893220555258},
                                      {20, 80.388512382919229},
                                      {10000, 40000.002019326954}};
  for (const auto& [ratio, length] : known) {
    EXPECT_NEAR(Shape::ellipse(ratio, 1).perimeter(), length, 1e-15 * length) << ratio;
    EXPECT_NEAR(Shape::ellipse(1, ratio).perimeter(), length, 1e-15 * length) << ratio;
  }
}

// Central differences with the step h = 1e-5 have errors of 1e-16/h and of h^2, for the turn of the
// normal times the fourth power of the ratio of the axes (here 20, but not at the tip).
TEST(Shape, NormalSpeedAndCurvatureAreThoseOfTheOutline) {
  constexpr double h = 1e-5;
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name());
    const double size = shape.bounding_radius();
    for (int i = 0; i < 97; ++i) {
      const double t = -7 + 0.151 * i;
      const auto at = shape.at(t), before = shape.at(t - h), after = shape.at(t + h);
      EXPECT_NEAR(norm(at.normal), 1, 1e-15);
      const Vector2 derivative = (1 / (2 * h)) * (after.point - before.point);
      const Vector2 tangent = at.speed * quarter_turn(at.normal);
      const double turn = cross(before.normal, after.normal) / (2 * h);
      const bool is_round =
          cross(before.normal, at.normal) > 0 && cross(at.normal, after.normal) > 0;
      const bool is_straight = before.normal == after.normal;
      if (!is_round && !is_straight) continue;  // where a side meets an end
      EXPECT_NEAR(norm(derivative - tangent), 0, 1e-8 * size) << t;
      if (is_round) {
        EXPECT_NEAR(turn * at.curvature_radius, at.speed, 1e-6 * at.speed) << t;
      } else {
        EXPECT_EQ(std::abs(at.normal[1]), 1);
        EXPECT_EQ(shape.kind(), ShapeKind::kPlate);
      }
    }
  }
}

TEST(Shape, RadiiAreExtremesOfTheOutline) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name());
    double largest = 0, least = 1e300;
    for (int i = 0; i < 3600; ++i) {
      const auto at = shape.at(2 * pi * i / 3600);
      largest = std::max(largest, norm(at.point));
      least = std::min(least, at.curvature_radius);
    }
    EXPECT_NEAR(shape.bounding_radius(), largest, 1e-14 * largest);
    EXPECT_NEAR(shape.least_curvature_radius(), least, 1e-14 * largest);
  }
}

TEST(Shape, TheSupportIsThatOfTheOutlinesPointWithTheNormal) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name());
    const double error = 1e-14 * shape.bounding_radius();
    for (int i = 0; i < 360; ++i) {
      const auto at = shape.at(2 * pi * (i + 0.1) / 360);
      const auto arc = shape.arc_at(at.normal);
      EXPECT_NEAR(shape.support(at.normal), dot(at.point, at.normal), error);
      EXPECT_NEAR(arc.curvature_radius(at.normal), at.curvature_radius,
                  1e-14 * at.curvature_radius);
      bool is_on_side = false;
      for (int k = 0; k < shape.sides(); ++k)
        is_on_side = is_on_side || dot(shape.side(k).normal, at.normal) > 1 - 1e-14;
      if (is_on_side) continue;
      EXPECT_NEAR(norm(shape.support_point(at.normal) - at.point), 0,
                  error * at.curvature_radius / shape.least_curvature_radius());
    }
  }
}

TEST(Shape, SidesOfAPlateGoAroundIt) {
  const auto plate = Shape::plate(3, 1);
  ASSERT_EQ(plate.sides(), 2);
  const Side top = plate.side(0), bottom = plate.side(1);
  EXPECT_EQ(top.normal, (Vector2{0, 1}));
  EXPECT_EQ(top.from, (Vector2{2, 1}));
  EXPECT_EQ(top.to, (Vector2{-2, 1}));
  EXPECT_EQ(top.before.centre, (Vector2{2, 0}));
  EXPECT_EQ(top.after.centre, (Vector2{-2, 0}));
  EXPECT_EQ(bottom.normal, (Vector2{0, -1}));
  EXPECT_EQ(bottom.from, (Vector2{-2, -1}));
  EXPECT_EQ(bottom.to, (Vector2{2, -1}));
  for (const auto& shape : shapes())
    EXPECT_EQ(shape.sides(), shape.kind() == ShapeKind::kPlate ? 2 : 0);
}

TEST(Shape, NamesAreThoseOfTheKinds) {
  EXPECT_EQ(Shape::disc(1).name(), "disc");
  EXPECT_EQ(Shape::sphere(1).name(), "sphere");
  EXPECT_EQ(Shape::plate(2, 1).name(), "plate");
  EXPECT_EQ(Shape::ellipse(2, 1).name(), "ellipse");
}

}  // namespace
}  // namespace viscontact::particles
