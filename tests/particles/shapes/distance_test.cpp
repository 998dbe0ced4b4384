// Distances of random shapes against a search with long doubles, the conditions of nearest points,
// derivatives, and invariances.
#include "viscontact/particles/shapes/distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/particles/shapes/random_shapes.hpp"

namespace viscontact::particles {
namespace {

using Long = long double;
using LongVector = std::array<Long, 2>;
using std::numbers::pi;

Long long_dot(const LongVector& a, const LongVector& b) { return a[0] * b[0] + a[1] * b[1]; }
LongVector direction(Long phi) { return {std::cos(phi), std::sin(phi)}; }

/// The support point of a shape with the normal n, relative to its centre.
LongVector long_support_point(const PlacedShape& placed, const LongVector& n) {
  const Long scale = std::hypot(Long{placed.axis[0]}, Long{placed.axis[1]});
  const LongVector e = {placed.axis[0] / scale, placed.axis[1] / scale};
  const LongVector own = {long_dot(e, n), e[0] * n[1] - e[1] * n[0]};
  const Long a = placed.shape.semi_axes()[0], b = placed.shape.semi_axes()[1];
  LongVector point{};
  switch (placed.shape.kind()) {
    case ShapeKind::kDisc:
    case ShapeKind::kSphere:
      point = {a * own[0], a * own[1]};
      break;
    case ShapeKind::kPlate:
      point = {b * own[0] + (own[0] < 0 ? b - a : a - b), b * own[1]};
      break;
    case ShapeKind::kEllipse: {
      const Long h = std::sqrt(a * a * own[0] * own[0] + b * b * own[1] * own[1]);
      point = {a * a * own[0] / h, b * b * own[1] / h};
    }
  }
  return {e[0] * point[0] - e[1] * point[1], e[1] * point[0] + e[0] * point[1]};
}

/// The gap of the lines perpendicular to a direction that bound the shapes, and its derivative by
/// the angle.
struct LongPair {
  const PlacedShape &first, &second;

  LongVector between(const LongVector& n) const {
    const auto one = long_support_point(first, n), two = long_support_point(second, {-n[0], -n[1]});
    return {Long{second.centre[0]} - first.centre[0] + two[0] - one[0],
            Long{second.centre[1]} - first.centre[1] + two[1] - one[1]};
  }
  Long gap(Long phi) const {
    const auto n = direction(phi);
    return long_dot(between(n), n);
  }
  Long slope(Long phi) const {
    const auto n = direction(phi);
    return long_dot(between(n), {-n[1], n[0]});
  }
};

struct LongResult {
  Long gap = -HUGE_VALL, phi = 0;
};

/// The largest of all maxima that a grid of directions shows; each is found by bisection.
LongResult search(const PlacedShape& first, const PlacedShape& second) {
  const LongPair pair{first, second};
  constexpr int kDirections = 2048;
  constexpr Long kStep = 2 * std::numbers::pi_v<Long> / kDirections;
  std::vector<Long> gaps(kDirections);
  for (int i = 0; i < kDirections; ++i) gaps[static_cast<std::size_t>(i)] = pair.gap(i * kStep);
  const auto gap_at = [&](int i) {
    return gaps[static_cast<std::size_t>((i + kDirections) % kDirections)];
  };
  LongResult best;
  for (int i = 0; i < kDirections; ++i) {
    if (gap_at(i) < gap_at(i - 1) || gap_at(i) < gap_at(i + 1)) continue;
    Long low = (i - 1) * kStep, high = (i + 1) * kStep;
    for (int n = 0; n < 70; ++n) {
      const Long middle = (low + high) / 2;
      (pair.slope(middle) > 0 ? low : high) = middle;
    }
    const Long gap = std::max(pair.gap(low), pair.gap(high));
    if (gap > best.gap) best = {gap, low};
  }
  return best;
}

double size_of_pair(const PlacedShape& first, const PlacedShape& second) {
  return first.shape.bounding_radius() + second.shape.bounding_radius() +
         norm(second.centre - first.centre);
}

double curvature_radius(const PlacedShape& placed, const Vector2& normal) {
  const Vector2 own = along_axes(placed.axis, normal);
  return placed.shape.arc_at(own).curvature_radius(own);
}

/// How far a point relative to the centre of a shape is from the line with the normal that bounds
/// the shape, and beyond the outline [L].
double distance_from_outline(const PlacedShape& placed, const Vector2& arm, const Vector2& normal) {
  const Vector2 own = along_axes(placed.axis, arm), n = along_axes(placed.axis, normal);
  const auto [a, b] = placed.shape.semi_axes();
  const double of_line = placed.shape.support(n) - dot(own, n);
  double of_outline = 0;
  if (placed.shape.kind() == ShapeKind::kPlate) {
    const double beyond = std::max(0.0, std::abs(own[0]) - (a - b));
    of_outline = norm(Vector2{beyond, own[1]}) - b;
  } else if (a > 0) {
    of_outline = (norm(Vector2{own[0] / a, own[1] / b}) - 1) * std::min(a, b);
  }
  return std::max(std::abs(of_line), std::abs(of_outline));
}

const std::vector<ShapeKind> kKinds = {ShapeKind::kDisc, ShapeKind::kPlate, ShapeKind::kEllipse};

/// Calls test(first, second, gap) for random pairs of all kinds, with gaps from -1e-2 of the least
/// curvature radius to 1e3 sizes.
template <class Test>
void for_random_pairs(unsigned seed, int count, double most_ratio, double most_size,
                      const Test& test) {
  RandomShapes random(seed);
  for (const auto one : kKinds)
    for (const auto other : kKinds)
      for (int n = 0; n < count; ++n) {
        const auto first = random.at_random_angle(random.shape(one, most_ratio, most_size));
        auto second = random.at_random_angle(random.shape(other, most_ratio, most_size));
        if (other == ShapeKind::kDisc && n % 4 == 0) second.shape = Shape::disc(0);
        const double least =
            first.shape.least_curvature_radius() + second.shape.least_curvature_radius();
        const double gap = n % 4 == 0 ? -least * random.log_uniform(1e-12, 1e-2)
                           : n % 4 == 1
                               ? 0
                               : random.log_uniform(1e-12, 1e3) * first.shape.bounding_radius();
        random.place(first, second, gap);
        test(first, second);
      }
}

// Rounding errors of the places are some 1e-16 of the size, and those of the normal this over the
// least of what turns it: gap plus curvature radii. The largest errors found are a third of these.
TEST(Distance, IsThatOfASearchWithLongDoubles) {
  for_random_pairs(1, 300, 20, 1000, [](const PlacedShape& first, const PlacedShape& second) {
    const auto found = nearest_points(first, second);
    const auto exact = search(first, second);
    const double size = size_of_pair(first, second);
    EXPECT_NEAR(found.gap, static_cast<double>(exact.gap), 1e-15 * size);
    const double bend =
        found.gap + curvature_radius(first, found.normal) + curvature_radius(second, -found.normal);
    const auto n = direction(exact.phi);
    EXPECT_NEAR(static_cast<double>(found.normal[0] * n[1] - found.normal[1] * n[0]), 0,
                6e-16 * (1 + size / bend));
    EXPECT_GT(static_cast<double>(found.normal[0] * n[0] + found.normal[1] * n[1]), 0);
  });
}

TEST(Distance, NearestPointsAreOnBothOutlinesAndTheNormal) {
  for_random_pairs(2, 300, 20, 1000, [](const PlacedShape& first, const PlacedShape& second) {
    const auto found = nearest_points(first, second);
    const double error = 4e-15 * size_of_pair(first, second);
    EXPECT_NEAR(norm(found.normal), 1, 1e-15);
    EXPECT_LT(distance_from_outline(first, found.first_arm, found.normal), error);
    EXPECT_LT(distance_from_outline(second, found.second_arm, -found.normal), error);
    const Vector2 across = (second.centre + found.second_arm) - (first.centre + found.first_arm);
    EXPECT_LT(norm(across - found.gap * found.normal), error);
  });
}

// Everything is an odd function of the places, so that the order decides nothing. The middle of two
// facing sides is computed from the first of them, with other rounding errors.
TEST(Distance, ExchangedShapesGiveTheSameBits) {
  for_random_pairs(3, 200, 20, 1000, [](const PlacedShape& first, const PlacedShape& second) {
    const auto one = nearest_points(first, second), other = nearest_points(second, first);
    EXPECT_EQ(one.gap, other.gap);
    EXPECT_EQ(one.normal, -other.normal);
    EXPECT_EQ(one.first_arm, other.second_arm);
    EXPECT_EQ(one.second_arm, other.first_arm);
  });
}

PlacedShape scaled(const PlacedShape& placed, double unit) {
  return {Shape(placed.shape.kind(), unit * placed.shape.semi_axes()), unit * placed.centre,
          placed.axis};
}

TEST(Distance, PowersOfTwoScaleTheBits) {
  RandomShapes random(4);
  for_random_pairs(5, 100, 20, 1000, [&](const PlacedShape& first, const PlacedShape& second) {
    const double unit = std::ldexp(1, static_cast<int>(random.uniform(-33, 34)));  // ten decades
    const auto one = nearest_points(first, second);
    const auto other = nearest_points(scaled(first, unit), scaled(second, unit));
    EXPECT_EQ(unit * one.gap, other.gap);
    EXPECT_EQ(one.normal, other.normal);
    EXPECT_EQ(unit * one.first_arm, other.first_arm);
    EXPECT_EQ(unit * one.second_arm, other.second_arm);
  });
}

// The scaled sizes and places are rounded to 1e-16 of themselves.
TEST(Distance, TheUnitDoesNotMatter) {
  RandomShapes random(6);
  for_random_pairs(7, 100, 20, 1000, [&](const PlacedShape& first, const PlacedShape& second) {
    const double unit = random.log_uniform(1e-5, 1e5);
    const auto one = nearest_points(first, second);
    const auto other = nearest_points(scaled(first, unit), scaled(second, unit));
    EXPECT_NEAR(one.gap, other.gap / unit, 2e-15 * size_of_pair(first, second));
  });
}

// Multiples of 2^-30 up to 2^20 have exact differences.
TEST(Distance, OnlyTheDifferenceOfTheCentresMatters) {
  RandomShapes random(8);
  const auto rounded = [](double x) { return std::ldexp(std::round(std::ldexp(x, 30)), -30); };
  for_random_pairs(9, 100, 20, 10, [&](PlacedShape first, PlacedShape second) {
    for (std::size_t d = 0; d < 2; ++d) {
      first.centre[d] = rounded(first.centre[d]);
      second.centre[d] = rounded(second.centre[d]);
    }
    const auto one = nearest_points(first, second);
    const Vector2 shift = {rounded(random.uniform(-1e6, 1e6)), rounded(random.uniform(-1e6, 1e6))};
    first.centre = first.centre + shift;
    second.centre = second.centre + shift;
    const auto other = nearest_points(first, second);
    EXPECT_EQ(one.gap, other.gap);
    EXPECT_EQ(one.normal, other.normal);
  });
}

// The angles of axes, turned by a random angle, are rounded to some 1e-16.
TEST(Distance, TurningBothShapesTurnsTheNormal) {
  RandomShapes random(10);
  for_random_pairs(11, 100, 20, 100, [&](const PlacedShape& first, const PlacedShape& second) {
    const auto one = nearest_points(first, second);
    const Vector2 turn = random.direction();
    const auto turned = [&](const PlacedShape& placed) {
      return PlacedShape{placed.shape, from_axes(turn, placed.centre),
                         from_axes(turn, placed.axis)};
    };
    const auto other = nearest_points(turned(first), turned(second));
    const double size = size_of_pair(first, second);
    const double bend =
        one.gap + curvature_radius(first, one.normal) + curvature_radius(second, -one.normal);
    EXPECT_NEAR(one.gap, other.gap, 3e-15 * size);
    EXPECT_LT(norm(from_axes(turn, one.normal) - other.normal), 3e-15 * (1 + size / bend));
  });
}

// A guess that is not between lines that separate the shapes is not used, and others give the same
// maximum, to the rounding errors of the first test.
TEST(Distance, AGuessDoesNotChangeTheResult) {
  RandomShapes random(12);
  for_random_pairs(13, 100, 20, 1000, [&](const PlacedShape& first, const PlacedShape& second) {
    const auto one = nearest_points(first, second);
    const double size = size_of_pair(first, second);
    const double bend =
        one.gap + curvature_radius(first, one.normal) + curvature_radius(second, -one.normal);
    const Vector2 near = unit(one.normal + random.uniform(-1e-2, 1e-2) * quarter_turn(one.normal));
    for (const Vector2& guess : {one.normal, near, -one.normal, random.direction()}) {
      const auto other = nearest_points(first, second, guess);
      EXPECT_NEAR(one.gap, other.gap, 1e-15 * size);
      EXPECT_LT(norm(one.normal - other.normal), 1e-15 * (1 + size / bend));
    }
  });
}

// Where one shape moves along the normal, the normal stays, and the gap changes by the motion, down
// to overlaps of the least curvature radii.
TEST(Distance, TheGapGoesThroughZeroWithTheMotionAlongTheNormal) {
  for_random_pairs(14, 60, 20, 100, [](const PlacedShape& first, PlacedShape second) {
    const auto start = nearest_points(first, second);
    const Vector2 centre = second.centre;
    const double least =
        first.shape.least_curvature_radius() + second.shape.least_curvature_radius();
    for (const double gap : {-0.9, -0.3, -1e-3, -1e-9, 0.0, 1e-9, 1e-3, 0.3, 10.0}) {
      second.centre = centre + (gap * least - start.gap) * start.normal;
      const double size = std::max(size_of_pair(first, second), norm(centre - first.centre));
      EXPECT_NEAR(nearest_points(first, second).gap, gap * least, 4e-15 * size);
    }
  });
}

// Central differences of motions by h least curvature radii. The errors are h^2 times the third
// derivative, and rounding errors of size/h.
TEST(Distance, TheRateOfTheGapIsThatOfBothPointsAlongTheNormal) {
  RandomShapes random(15);
  for_random_pairs(16, 200, 4, 4, [&](const PlacedShape& first, const PlacedShape& second) {
    const auto at = nearest_points(first, second);
    struct Velocity {
      Vector2 of_centre;
      double angular;
    };
    const auto moved = [](const PlacedShape& placed, const Velocity& velocity, double h) {
      const double turn = velocity.angular * h;
      return PlacedShape{placed.shape, placed.centre + h * velocity.of_centre,
                         from_axes({std::cos(turn), std::sin(turn)}, placed.axis)};
    };
    const Velocity one{random.direction(), random.uniform(-1, 1)};
    const Velocity other{random.direction(), random.uniform(-1, 1)};
    const double h = 1e-5 * std::min(first.shape.least_curvature_radius(), 1.0);
    const auto gap = [&](double t) {
      return nearest_points(moved(first, one, t), moved(second, other, t)).gap;
    };
    const auto rate_of = [&](const Velocity& velocity, const Vector2& arm) {
      return dot(at.normal, velocity.of_centre + velocity.angular * quarter_turn(arm));
    };
    const double rate = rate_of(other, at.second_arm) - rate_of(one, at.first_arm);
    const double size = size_of_pair(first, second);
    EXPECT_NEAR((gap(h) - gap(-h)) / (2 * h), rate, 1e-15 * size / h + 1e-8 * size);
  });
}

// The search has the exact maximum of all; the kernel may take another one whose gap is the same to
// rounding errors.
TEST(Distance, DeepOverlapsAreShortestTranslations) {
  RandomShapes random(17);
  for (const auto one : kKinds)
    for (const auto other : kKinds)
      for (int n = 0; n < 150; ++n) {
        const auto first = random.at_random_angle(random.shape(one, 20, 30));
        auto second = random.at_random_angle(random.shape(other, 20, 30));
        random.place(first, second, 0);
        second.centre = first.centre + random.uniform(0, 1) * (second.centre - first.centre);
        const auto found = nearest_points(first, second);
        EXPECT_NEAR(found.gap, static_cast<double>(search(first, second).gap),
                    1e-15 * size_of_pair(first, second));
      }
}

TEST(Distance, ShapesAroundOnePointOverlap) {
  const auto disc = Shape::disc(2), plate = Shape::plate(3, 1), ellipse = Shape::ellipse(3, 1);
  const auto gap = [](const Shape& first, const Shape& second) {
    return nearest_points({first, {1, 1}}, {second, {1, 1}}).gap;
  };
  EXPECT_DOUBLE_EQ(gap(disc, disc), -4);
  EXPECT_DOUBLE_EQ(gap(disc, plate), -3);
  EXPECT_DOUBLE_EQ(gap(plate, disc), -3);
  EXPECT_DOUBLE_EQ(gap(ellipse, disc), -3);
  EXPECT_DOUBLE_EQ(gap(ellipse, ellipse), -2);
  EXPECT_DOUBLE_EQ(gap(plate, plate), -2);
  EXPECT_DOUBLE_EQ(gap(plate, Shape::disc(0)), -1);
}

// Where the normal is not determined, because the gap is minus the sum of the curvature radii, any
// normal is a result, and the gap is as exact as elsewhere.
TEST(Distance, AtCentresOfCurvatureTheGapIsExact) {
  RandomShapes random(22);
  for (int n = 0; n < 3000; ++n) {
    const auto kind = kKinds[static_cast<std::size_t>(n) % kKinds.size()];
    const auto first = random.at_random_angle(random.shape(kind, 20, 10));
    const auto [a, b] = first.shape.semi_axes();
    const double least = first.shape.least_curvature_radius(), most = std::max(a, b);
    // The end of a plate's spine, the centre of a disc, that of the curvature of an ellipse's tip.
    Vector2 own = {most - least, 0};
    if (b > a) std::swap(own[0], own[1]);
    PlacedShape second{random.coin() ? Shape::disc(random.uniform(0, 3)) : Shape::disc(0),
                       first.centre + from_axes(first.axis, own)};
    for (auto& x : second.centre) x += random.uniform(-4, 4) * 1e-16;
    const std::optional<Vector2> guess =
        random.coin() ? std::optional(random.direction()) : std::nullopt;
    const auto found = nearest_points(first, second, guess);
    const double exact = -(least + second.shape.bounding_radius());
    EXPECT_NEAR(found.gap, exact, 1e-14 * size_of_pair(first, second));
    EXPECT_NEAR(norm(found.normal), 1, 1e-15);
  }
}

TEST(Distance, ClosedFormsOfDiscsPointsAndPlates) {
  const PlacedShape disc{Shape::disc(2), {1, 2}};
  const auto discs = nearest_points(disc, {Shape::disc(1), {4, 6}});
  EXPECT_EQ(discs.gap, 2);
  EXPECT_LT(norm(discs.normal - Vector2{0.6, 0.8}), 1e-15);
  EXPECT_LT(norm(discs.first_arm - Vector2{1.2, 1.6}), 1e-15);
  EXPECT_LT(norm(discs.second_arm - Vector2{-0.6, -0.8}), 1e-15);

  const PlacedShape plate{Shape::plate(3, 1), {0, 0}};
  const auto above = nearest_points(plate, {Shape::disc(0.5), {-1.25, 4}});
  EXPECT_EQ(above.gap, 2.5);
  EXPECT_EQ(above.normal, (Vector2{0, 1}));
  EXPECT_EQ(above.first_arm, (Vector2{-1.25, 1}));
  EXPECT_EQ(above.second_arm, (Vector2{0, -0.5}));
  const auto beyond = nearest_points(plate, {Shape::disc(0.5), {5, -4}});
  EXPECT_EQ(beyond.gap, 3.5);
  EXPECT_LT(norm(beyond.normal - Vector2{0.6, -0.8}), 1e-15);
  EXPECT_LT(norm(beyond.first_arm - Vector2{2.6, -0.8}), 1e-15);
}

TEST(Distance, PlatesSideBySideTouchInTheMiddleOfTheFacingPart) {
  RandomShapes random(18);
  for (int n = 0; n < 200; ++n) {
    const double l = random.log_uniform(0.1, 10), b = random.log_uniform(0.1, 10);
    const double m = random.log_uniform(0.1, 10), c = random.log_uniform(0.1, 10);
    const double along = random.uniform(-1, 1) * (l + m), gap = random.uniform(-0.1, 5) * (b + c);
    const double angle = random.angle(), half_turn = random.coin() ? pi : 0;
    auto first = PlacedShape::at_angle(Shape::plate(l + b, b), {random.uniform(-1, 1), 2}, angle);
    auto second = PlacedShape::at_angle(Shape::plate(m + c, c), {}, angle + half_turn);
    const Vector2 normal = quarter_turn(first.axis);
    second.centre = first.centre + along * first.axis + (gap + b + c) * normal;
    const double middle = (std::max(-l, along - m) + std::min(l, along + m)) / 2;
    const auto found = nearest_points(first, second), exchanged = nearest_points(second, first);
    const double error = 1e-14 * size_of_pair(first, second);
    EXPECT_NEAR(found.gap, gap, error);
    EXPECT_LT(norm(found.normal - normal), 2e-15);
    EXPECT_LT(norm(found.first_arm - (middle * first.axis + b * normal)), error);
    EXPECT_LT(norm(found.second_arm - ((middle - along) * first.axis - c * normal)), error);
    EXPECT_NEAR(exchanged.gap, gap, error);
    EXPECT_LT(norm(exchanged.normal + normal), 2e-15);
    EXPECT_LT(norm(exchanged.first_arm - found.second_arm), error);
    EXPECT_LT(norm(exchanged.second_arm - found.first_arm), error);
  }
}

// In one direction, but not side by side, ends touch.
TEST(Distance, ParallelPlatesBeyondEachOtherTouchWithTheirEnds) {
  RandomShapes random(23);
  for (int n = 0; n < 200; ++n) {
    const double l = random.log_uniform(0.1, 10), b = random.log_uniform(0.1, 10);
    const double m = random.log_uniform(0.1, 10), c = random.log_uniform(0.1, 10);
    const double sign = random.coin() ? 1 : -1, up = random.coin() ? 1 : -1;
    const double beyond = random.log_uniform(1e-3, 10), height = random.log_uniform(1e-3, 10);
    const double angle = random.angle(), half_turn = random.coin() ? pi : 0;
    const auto first = PlacedShape::at_angle(Shape::plate(l + b, b), {1, 2}, angle);
    auto second = PlacedShape::at_angle(Shape::plate(m + c, c), {}, angle + half_turn);
    const Vector2 between = {sign * (l + m + beyond), up * height};
    second.centre = first.centre + from_axes(first.axis, between);
    const auto found = nearest_points(first, second);
    const double error = 1e-14 * size_of_pair(first, second);
    const Vector2 apart = {sign * beyond, up * height}, normal = unit(apart);
    EXPECT_NEAR(found.gap, norm(apart) - b - c, error);
    EXPECT_LT(norm(along_axes(first.axis, found.first_arm) - (Vector2{sign * l, 0} + b * normal)),
              error * (1 + b / norm(apart)));
    EXPECT_LT(norm(along_axes(first.axis, found.second_arm) + (Vector2{sign * m, 0} + c * normal)),
              error * (1 + c / norm(apart)));
  }
}

// The normal is that of the side, or next to it, where rounding errors must not take the other end.
TEST(Distance, APointBeyondTheEndOfASideIsNearestToThatEnd) {
  RandomShapes random(19);
  for (int n = 0; n < 2000; ++n) {
    const auto plate = random.at_random_angle(random.shape(ShapeKind::kPlate, 20, 10));
    const auto [a, b] = plate.shape.semi_axes();
    const double beyond = random.log_uniform(1e-20, 1e-10),
                 height = b + random.log_uniform(1e-9, 5);
    const double sign = random.coin() ? 1 : -1, up = random.coin() ? 1 : -1;
    const Vector2 at = {sign * (a - b + beyond), up * height};
    const PlacedShape point{Shape::disc(0), plate.centre + from_axes(plate.axis, at)};
    const double turn = random.uniform(-3e-16, 3e-16);
    const Vector2 guess = from_axes(plate.axis, {turn, up});
    for (const auto& found : {nearest_points(plate, point), nearest_points(plate, point, guess)}) {
      const Vector2 own = along_axes(plate.axis, found.first_arm);
      EXPECT_NEAR(own[0], sign * (a - b), 1e-9);
      EXPECT_NEAR(own[1], up * b, 1e-9);
    }
  }
}

TEST(Distance, OfAStraightWallIsThatOfTheSupportPoint) {
  RandomShapes random(20);
  for (int n = 0; n < 1000; ++n) {
    const auto kind = kKinds[static_cast<std::size_t>(n) % kKinds.size()];
    const auto shape = random.at_random_angle(random.shape(kind, 20, 1000));
    const Vector2 normal = random.direction(), point = 10.0 * random.direction();
    const auto found = nearest_to_wall(shape, point, normal);
    const LongVector n_long = {normal[0], normal[1]};
    const auto arm = long_support_point(shape, {-n_long[0], -n_long[1]});
    const LongVector from_wall = {shape.centre[0] + arm[0] - point[0],
                                  shape.centre[1] + arm[1] - point[1]};
    const double size = shape.shape.bounding_radius() + 10;
    EXPECT_NEAR(found.gap, static_cast<double>(long_dot(from_wall, n_long)), 1e-15 * size);
    EXPECT_EQ(found.normal, -normal);
    EXPECT_LT(distance_from_outline(shape, found.first_arm, -normal), 1e-15 * size);
    EXPECT_NEAR(dot(shape.centre + found.first_arm - point, normal), found.gap, 2e-15 * size);
  }
  const auto lying = nearest_to_wall({Shape::plate(3, 1), {0, 5}}, {7, 1}, {0, 1});
  EXPECT_EQ(lying.gap, 3);
  EXPECT_EQ(lying.first_arm, (Vector2{0, -1}));
}

/// The points of the outline that are further from `centre` than both neighbours on a grid, and
/// their distances, with the largest first.
std::vector<double> far_points_by_search(const PlacedShape& shape, const Vector2& centre) {
  constexpr int kPoints = 20'000;
  const auto distance = [&](double t) { return norm(shape.at(t).point - centre); };
  std::vector<double> grid(kPoints), found;
  for (int i = 0; i < kPoints; ++i)
    grid[static_cast<std::size_t>(i)] = distance(2 * pi * (i + 0.5) / kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const auto at = [&](int k) { return grid[static_cast<std::size_t>((k + kPoints) % kPoints)]; };
    if (at(i) <= at(i - 1) || at(i) < at(i + 1)) continue;
    double low = 2 * pi * (i - 0.5) / kPoints, high = low + 4 * pi / kPoints;
    for (int n = 0; n < 60; ++n) {
      const double first = low + (high - low) / 3, second = high - (high - low) / 3;
      (distance(first) > distance(second) ? high : low) =
          distance(first) > distance(second) ? second : first;
    }
    found.push_back(distance((low + high) / 2));
  }
  std::ranges::sort(found, std::greater<>());
  return found;
}

// A grid misses two maxima that are closer than its points, so that a few counts differ.
TEST(Distance, InARoundWallIsThatOfTheOneOrTwoFarthestPoints) {
  RandomShapes random(21);
  int different = 0, twice = 0;
  for (int n = 0; n < 600; ++n) {
    const auto kind = n % 2 == 0 ? ShapeKind::kPlate : ShapeKind::kEllipse;
    const auto shape = random.at_random_angle(random.shape(kind, 20, 10));
    const double size = shape.shape.bounding_radius(), radius = 3 * size;
    const Vector2 centre = shape.centre + random.log_uniform(1e-3, 3) * size * random.direction();
    const auto found = nearest_to_round_wall(shape, centre, radius);
    const auto far = far_points_by_search(shape, centre);
    if (far.size() != static_cast<std::size_t>(found.count)) {
      ++different;
      continue;
    }
    twice += found.count == 2 ? 1 : 0;
    for (std::size_t k = 0; k < far.size(); ++k) {
      const auto& place = found.places[k];
      const double error = 4e-15 * (radius + size);
      EXPECT_NEAR(place.gap, radius - far[k], error);
      EXPECT_LT(distance_from_outline(shape, place.first_arm, place.normal), error);
      EXPECT_LT(norm(shape.centre + place.first_arm - centre - (radius - place.gap) * place.normal),
                error);
    }
    if (found.count == 2) {
      EXPECT_LE(found.places[0].gap, found.places[1].gap + 1e-15 * radius);
    }
  }
  EXPECT_LE(different, 3);
  EXPECT_GT(twice, 100);
}

TEST(Distance, AnEllipseInARoundWallTouchesWithBothTips) {
  for (const double angle : {0.0, 0.3, pi / 2, 2.0}) {
    // Above the centre of the wall, where its tips are as far from it as from each other.
    auto ellipse = PlacedShape::at_angle(Shape::ellipse(3, 1), {}, angle);
    const Vector2 up = quarter_turn(ellipse.axis);
    for (const double away : {0.0, 0.5, -0.5, 3.0}) {
      ellipse.centre = Vector2{7, -2} + away * up;
      const auto found = nearest_to_round_wall(ellipse, {7, -2}, 4);
      ASSERT_EQ(found.count, 2) << angle << ' ' << away;
      EXPECT_NEAR(found.places[0].gap, found.places[1].gap, 4e-15);
      EXPECT_NEAR(dot(found.places[0].normal, ellipse.axis),
                  -dot(found.places[1].normal, ellipse.axis), 1e-14);
      // Squares of the distance, (3 cos t)^2 + (away + sin t)^2, are largest at sin t = away/8.
      EXPECT_NEAR(4 - found.places[0].gap, std::sqrt(9 + away * away + away * away / 8), 4e-15);
    }
    ellipse.centre = Vector2{7, -2} + 8.5 * up;  // beyond the centre of curvature of its side
    const auto found = nearest_to_round_wall(ellipse, {7, -2}, 10);
    ASSERT_EQ(found.count, 1);
    EXPECT_NEAR(found.places[0].gap, 0.5, 4e-15);
  }
  const auto tip = nearest_to_round_wall({Shape::ellipse(1, 3), {0, 1}}, {0, 0}, 5);
  ASSERT_EQ(tip.count, 2);
  EXPECT_EQ(tip.places[0].gap, 1);
  EXPECT_EQ(tip.places[0].normal, (Vector2{0, 1}));
  EXPECT_EQ(tip.places[1].gap, 3);
  EXPECT_EQ(tip.places[1].normal, (Vector2{0, -1}));
}

TEST(Distance, ADiscInARoundWallTouchesOnce) {
  const auto found = nearest_to_round_wall({Shape::disc(1), {3, 4}}, {0, 0}, 10);
  ASSERT_EQ(found.count, 1);
  EXPECT_EQ(found.places[0].gap, 4);
  EXPECT_LT(norm(found.places[0].normal - Vector2{0.6, 0.8}), 1e-15);
  const auto middle = nearest_to_round_wall({Shape::disc(1), {0, 0}}, {0, 0}, 10);
  EXPECT_EQ(middle.places[0].gap, 9);
  EXPECT_EQ(norm(middle.places[0].normal), 1);
}

}  // namespace
}  // namespace viscontact::particles
