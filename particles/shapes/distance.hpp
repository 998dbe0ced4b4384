// Signed distances of convex shapes in the plane, and the points and normals at which they are
// attained, from support functions.
#pragma once

#include <optional>

#include "viscontact/particles/shapes/shape.hpp"

namespace viscontact::particles {

/// A shape and where it is.
struct PlacedShape {
  Shape shape;
  Vector2 centre{};       ///< [L]
  Vector2 axis = {1, 0};  ///< unit vector along the first axis of the shape

  /// `angle` is that from the x axis to the first axis of the shape [rad].
  static PlacedShape at_angle(const Shape& shape, const Vector2& centre, double angle);
  /// Shape::at() of the parameter t, at this place: its point is a place [L].
  OutlinePoint at(double t) const;
  /// Distance of the point x [L] from the outline [L]; < 0 inside.
  double distance_to(const Vector2& x) const {
    return shape.distance_to(along_axes(axis, x - centre));
  }
};

/// The nearest points x_1 and x_2 of two shapes, x_2 = x_1 + gap n. If the shapes overlap, they are
/// the points that touch after the shortest translation that separates the shapes.
struct NearestPoints {
  /// Distance [L]; < 0 if the shapes overlap, and then minus the length of the shortest translation
  /// that separates them. Its derivative in time is n.(velocity of the second shape at x_2 -
  /// velocity of the first at x_1).
  double gap = 0;
  Vector2 normal{};     ///< unit normal n, from the first shape to the second [1]
  Vector2 first_arm{},  ///< x_1 - centre of the first shape [L]
      second_arm{};     ///< x_2 - centre of the second shape [L]; 0 for a wall
};

/// The maximum over all unit vectors n of the gap n.(c_2 - c_1) - h_1(n) - h_2(-n) between the two
/// lines perpendicular to n that bound the shapes, where c are their centres and h their support
/// functions. Among equally near points, those in the middle of two facing sides are returned.
///
/// If the shapes are apart, or overlap by less than the sum of their least curvature radii, then
/// there is one maximum, and `guess`, a unit normal, say of the step before, only saves time. If
/// they overlap more, a search finds the largest of several maxima, except if two are almost equal,
/// and `guess` is not used. The gap has a rounding error of some 1e-16 of the sizes and the
/// distance; the normal has one of this over the sum of the gap and both curvature radii. If both
/// shapes are exchanged, the results are the same bits, with -n, unless two sides face each other.
NearestPoints nearest_points(const PlacedShape& first, const PlacedShape& second,
                             const std::optional<Vector2>& guess = {});

/// The point of the shape that is nearest to a straight wall, which is the second shape. `point`
/// [L] is any point of the wall, `normal` its unit normal, out of the wall. If a side of the shape
/// is parallel to the wall, its middle is returned.
NearestPoints nearest_to_wall(const PlacedShape& shape, const Vector2& point,
                              const Vector2& normal);

/// The places where a shape within a round wall is nearer to it than beside them. The nearest one
/// is the first.
struct NearestToRoundWall {
  int count = 0;  ///< 1 or 2
  std::array<NearestPoints, 2> places{};
};

/// `centre` and `radius` [L] are those of the wall, which is the second shape; each gap is `radius`
/// minus the distance of a point from `centre`. A disc around `centre` touches it along the first
/// axis.
NearestToRoundWall nearest_to_round_wall(const PlacedShape& shape, const Vector2& centre,
                                         double radius);

}  // namespace viscontact::particles
