// Gaps, places and arms of contacts of discs, plates and ellipses. Lengths are in one unit.
#include "viscontact/particles/shapes/shape_contacts.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/particles/shapes/random_shapes.hpp"

namespace viscontact::particles {
namespace {

using std::numbers::pi;
using testing::ElementsAre;
using testing::SizeIs;

PlacedShape plate(const Vector2& centre, double half_length, double end_radius, double angle) {
  return PlacedShape::at_angle(Shape::plate(half_length, end_radius), centre, angle);
}

PlacedShape ellipse(const Vector2& centre, double first, double second, double angle) {
  return PlacedShape::at_angle(Shape::ellipse(first, second), centre, angle);
}

TEST(Gap, OfPlatesIsThatOfTheirSpines) {
  const auto flat = plate({0, 0}, 2, 0.25, 0);
  // Beside the side, and before the end.
  EXPECT_NEAR(gap(flat, plate({1, 2}, 1, 0.5, pi / 2)), 2 - 0.5 - 0.5 - 0.25, 1e-14);
  EXPECT_NEAR(gap(flat, plate({4, 0}, 1, 0.5, 0)), 1, 1e-14);
  EXPECT_NEAR(gap(flat, {Shape::disc(0.5), {1, 2}}), 1.25, 1e-14);
  EXPECT_LT(gap(flat, plate({0.3, 0.1}, 2, 0.25, 1)), -0.5 + 1e-14);
  EXPECT_NEAR(gap(flat, ellipse({0.5, 3}, 1, 2, 0)), 0.75, 1e-14);
  const PlanePosition floor{{0, -1, 0}, {0, 1, 0}};
  EXPECT_NEAR(gap(floor, plate({0, 0}, 1, 0.1, 0.5)), 1 - 0.9 * std::sin(0.5) - 0.1, 1e-14);
}

// The search has 20000 points, whose distance errs by the square of their distance, 1e-7.
TEST(Gap, OfTwoPlatesIsTheLeastDistanceOfTheirPoints) {
  RandomShapes random(3);
  for (int n = 0; n < 20; ++n) {
    const auto one = plate({random.uniform(-2, 2), 0}, 1, 0.2, random.angle());
    const auto other = plate({random.uniform(-2, 2), 2.5}, 1.2, 0.1, random.angle());
    double least = std::numeric_limits<double>::infinity();
    constexpr int kPoints = 20'000;
    for (int i = 0; i < kPoints; ++i)
      least = std::min(least, other.distance_to(one.at(2 * pi * i / kPoints).point));
    EXPECT_NEAR(gap(one, other), least, 1e-6);
    EXPECT_NEAR(gap(one, other), gap(other, one), 1e-14);
  }
}

TEST(Gap, OfAnEllipseAndALineIsThatOfTheSupportFunction) {
  const PlanePosition line{{0, -1, 0}, {0, 1, 0}};
  for (const double angle : {0.0, 0.4, 1.2, -2.9}) {
    const double support = std::hypot(2 * std::sin(angle), 0.3 * std::cos(angle));
    EXPECT_NEAR(gap(line, ellipse({5, 3}, 2, 0.3, angle)), 4 - support, 1e-14);
  }
  const PlanePosition wall{{0, 0, 0}, {}, 4};
  EXPECT_NEAR(gap(wall, ellipse({0, 0}, 3, 1, 0.9)), 1, 1e-14);
}

TEST(Gap, OfAPointToAnEllipseIsExactOnTheAxes) {
  for (const double unit : {1e-6, 1.0, 1e6}) {
    const auto at = ellipse({0, 0}, 2 * unit, 1 * unit, 0);
    EXPECT_NEAR(at.distance_to({5 * unit, 0}), 3 * unit, 1e-14 * unit);
    EXPECT_NEAR(at.distance_to({0, 5 * unit}), 4 * unit, 1e-14 * unit);
    EXPECT_NEAR(at.distance_to({0, 0}), -1 * unit, 1e-14 * unit);
    // Within the evolute the nearest point of the long axis is beside the axis: b sqrt(1 - x^2/(a^2
    // - b^2)).
    EXPECT_NEAR(at.distance_to({unit, 0}), -unit * std::sqrt(1 - 1 / 3.0), 1e-14 * unit);
  }
}

// Outside, the distance of a point is its gap as a disc of the radius 0, in another way.
TEST(Gap, OfAPointIsTheDistance) {
  RandomShapes random(5);
  for (const auto kind : {ShapeKind::kDisc, ShapeKind::kPlate, ShapeKind::kEllipse})
    for (int n = 0; n < 200; ++n) {
      const auto shape = random.at_random_angle(random.shape(kind, 20, 1));
      const PlacedShape point{Shape::disc(0), {random.uniform(-4, 4), random.uniform(-4, 4)}};
      const double distance = shape.distance_to(point.centre);
      if (!(distance > 0)) continue;
      EXPECT_NEAR(distance, nearest_points(shape, point).gap, 1e-13);
    }
}

TEST(ShapeContacts, OfPlatesSideBySideAreAtBothEnds) {
  const auto low = plate({0, 0}, 2, 0.25, 0), high = plate({0.5, 1}, 1, 0.25, 0);
  const ShapeContacts contacts(low, high);
  ASSERT_THAT(contacts.places(), SizeIs(2));
  double arms = 0;
  for (const int place : contacts.places()) {
    const auto contact = contacts.at(place, low, high);
    EXPECT_NEAR(contact.gap, 0.5, 1e-15);
    EXPECT_THAT(contact.normal, ElementsAre(0, 1));
    arms += contact.levers()[1];
  }
  EXPECT_NEAR(arms, 0, 1e-15);  // one at each end
  // Where they cross, there is one.
  EXPECT_THAT(ShapeContacts(low, plate({0.5, 0.1}, 1, 0.25, 1.2)).places(), SizeIs(1));
  EXPECT_THAT(ShapeContacts(low, {Shape::disc(1), {0, 3}}).places(), ElementsAre(0));
  EXPECT_THAT(ShapeContacts(low, ellipse({0, 3}, 1, 2, 0)).places(), ElementsAre(0));
}

/// Moves a shape by `shift` [L], and then turns it about its centre.
PlacedShape moved(PlacedShape shape, const Vector2& shift, double turn) {
  shape.centre = shape.centre + shift;
  shape.axis = from_axes(shape.axis, {std::cos(turn), std::sin(turn)});
  return shape;
}

// Central differences over 1e-6 err by 1e-12 times the third derivative, and by rounding errors of
// 1e-16/1e-6.
TEST(ShapeContacts, LeversAreTheDerivativesOfTheGap) {
  RandomShapes random(7);
  for (const auto first_kind : {ShapeKind::kPlate, ShapeKind::kEllipse})
    for (const auto second_kind : {ShapeKind::kDisc, ShapeKind::kPlate, ShapeKind::kEllipse})
      for (int n = 0; n < 50; ++n) {
        const auto first = random.at_random_angle(random.shape(first_kind, 3, 2));
        auto second = random.at_random_angle(random.shape(second_kind, 3, 2));
        second.centre = second.centre + Vector2{6, 3};
        const ShapeContacts contacts(first, second);
        const int place = contacts.places().front();
        const auto contact = contacts.at(place, first, second);
        constexpr double kStep = 1e-6, kError = 1e-8;
        const auto gap_at = [&](const PlacedShape& one, const PlacedShape& other) {
          return contacts.at(place, one, other).gap / (2 * kStep);
        };
        const auto levers = contact.levers();
        EXPECT_NEAR(
            gap_at(moved(first, {}, kStep), second) - gap_at(moved(first, {}, -kStep), second),
            levers[0], kError);
        EXPECT_NEAR(
            gap_at(first, moved(second, {}, kStep)) - gap_at(first, moved(second, {}, -kStep)),
            levers[1], kError);
        EXPECT_NEAR(gap_at(first, moved(second, {kStep, 0}, 0)) -
                        gap_at(first, moved(second, {-kStep, 0}, 0)),
                    contact.normal[0], kError);
        // Both arms of friction end at one point.
        const auto arms = contact.friction_arms();
        EXPECT_NEAR(arms[0] + arms[1], dot(second.centre - first.centre, contact.normal), 1e-13);
      }
}

TEST(ShapeContacts, OfAnEllipseThatIsNearlyADiscIsThatOfTheDisc) {
  const PlacedShape disc{Shape::disc(1), {0, 0}}, other{Shape::disc(0.5), {1.5, 0.7}};
  const auto nearly = ellipse({0, 0}, 1, 1 + 1e-9, 0.3);
  const auto expected = ShapeContacts(disc, other).at(0, disc, other);
  const auto found = ShapeContacts(nearly, other).at(0, nearly, other);
  EXPECT_NEAR(found.gap, expected.gap, 1e-9);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(found.normal[k], expected.normal[k], 3e-9);
    EXPECT_NEAR(found.radii[k], expected.radii[k], 3e-9);
    EXPECT_NEAR(found.levers()[k], expected.levers()[k], 3e-9);
    EXPECT_NEAR(found.friction_arms()[k], expected.friction_arms()[k], 6e-9);
  }
}

TEST(WallContacts, OfAPlateAreItsEndsAndOfAnEllipseTheNearestPoint) {
  const PlanePosition floor{{0, 0, 0}, {0, 1, 0}};
  const auto lying = plate({3, 1}, 1, 0.1, 0.2);
  const WallContacts ends(floor, lying);
  ASSERT_THAT(ends.places(), ElementsAre(0, 1));
  EXPECT_NEAR(ends.at(0, floor, lying).gap, 0.9 + 0.9 * std::sin(0.2), 1e-15);
  EXPECT_NEAR(ends.at(1, floor, lying).gap, 0.9 - 0.9 * std::sin(0.2), 1e-15);
  EXPECT_NEAR(ends.at(1, floor, lying).on_obstacle[0], 3 - 0.9 * std::cos(0.2), 1e-15);

  const double angle = 0.4, height = std::hypot(2 * std::sin(angle), std::cos(angle));
  const auto tilted = ellipse({3, height + 0.5}, 2, 1, angle);
  const WallContacts one(floor, tilted);
  ASSERT_THAT(one.places(), ElementsAre(0));
  const auto contact = one.at(0, floor, tilted);
  EXPECT_NEAR(contact.gap, 0.5, 1e-15);
  EXPECT_NEAR(contact.radii[1], 4 / (height * height * height), 1e-14);
  // The lever is the derivative of the height by the angle, with the sign of the gap.
  EXPECT_NEAR(contact.levers()[1], -(4 - 1) * std::sin(angle) * std::cos(angle) / height, 1e-14);
  EXPECT_NEAR(contact.friction_arms()[1], height, 1e-14);
  EXPECT_NEAR(contact.on_obstacle[0], 3 - (4 - 1) * std::sin(angle) * std::cos(angle) / height,
              1e-14);
  EXPECT_NEAR(contact.on_obstacle[1], 0, 1e-14);
}

TEST(WallContacts, OfAnEllipseInARoundWallKeepTheirNumbers) {
  const PlanePosition wall{{0, 0, 0}, {}, 2.01};
  const auto across = ellipse({0.001, 0}, 2, 0.5, 0);
  const WallContacts both(wall, across);
  ASSERT_THAT(both.places(), ElementsAre(0, 1));
  EXPECT_NEAR(both.at(0, wall, across).gap, 0.009, 1e-14);
  EXPECT_NEAR(both.at(1, wall, across).gap, 0.011, 1e-14);
  const auto moved = ellipse({-0.001, 0}, 2, 0.5, 0.01);
  EXPECT_THAT(WallContacts(wall, moved).places(), ElementsAre(1, 0));
  EXPECT_NEAR(both.at(0, wall, moved).gap, 0.011, 1e-5);
  // Turned by half a turn, the numbers change their ends.
  EXPECT_THAT(WallContacts(wall, ellipse({0.001, 0}, 2, 0.5, pi)).places(), ElementsAre(1, 0));
  // In a wide wall a short ellipse has one.
  const PlanePosition wide{{0, 0, 0}, {}, 10};
  const auto round = ellipse({5, 0}, 1.1, 1, 0);
  const WallContacts one(wide, round);
  EXPECT_THAT(one.places(), ElementsAre(0));
  EXPECT_EQ(one.contact_of(1), 0);
  EXPECT_NEAR(one.at(0, wide, round).gap, 3.9, 1e-14);
}

}  // namespace
}  // namespace viscontact::particles
