// Shapes of rigid particles. Each kind, such as a plate with round ends, is a row of the table of
// shape_rule.hpp.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "viscontact/particles/values/vector2.hpp"

namespace viscontact::particles {

enum class ShapeKind : std::uint8_t;  // its values stand beside the table in shape_rule.hpp

/// A point of an outline and what the outline is like there.
struct OutlinePoint {
  Vector2 point{},              ///< relative to the centre [L]
      normal{};                 ///< unit normal, out of the shape [1]
  double speed = 0;             ///< length of the derivative of the point by its parameter [L]
  double curvature_radius = 0;  ///< [L]; beside a straight side that of the ends of the side
};

/// A part of a convex outline: the points of an ellipse, with its semi-axes along those of the
/// shape, whose normals lie between two directions. Equal semi-axes make it an arc of a circle, 0 a
/// corner.
struct Arc {
  Vector2 centre{};     ///< relative to the centre of the shape [L]
  Vector2 semi_axes{};  ///< [L]

  // The functions take a unit vector, and are relative to `centre`.
  double support(const Vector2& normal) const {
    return is_circle() ? semi_axes[0]
                       : norm(Vector2{semi_axes[0] * normal[0], semi_axes[1] * normal[1]});
  }
  Vector2 support_point(const Vector2& normal) const {
    if (is_circle()) return semi_axes[0] * normal;
    const double height = support(normal);
    return {semi_axes[0] / height * semi_axes[0] * normal[0],
            semi_axes[1] / height * semi_axes[1] * normal[1]};
  }
  /// Radius of curvature at support_point() [L], a^2 b^2/h^3 with the support h.
  double curvature_radius(const Vector2& normal) const {
    if (is_circle()) return semi_axes[0];
    const double height = support(normal), part = semi_axes[0] / height * semi_axes[1];
    return part * part / height;
  }
  bool is_circle() const { return semi_axes[0] == semi_axes[1]; }
};

/// A straight part of a convex outline, and the arcs before and after it, counter-clockwise.
struct Side {
  Vector2 normal{};  ///< unit normal, out of the shape [1]
  Vector2 from{},    ///< end at which `before` ends, relative to the centre of the shape [L]
      to{};          ///< end at which `after` begins [L]
  Arc before{}, after{};
  /// The parameters of Shape::at() at both ends. Those of the sides in their order increase, and
  /// differ by less than 2 pi.
  double from_parameter = 0, to_parameter = 0;
};

/// The points of an outline that are further from a given point than their neighbours on the
/// outline are, at most two, and their distances from it. The first one is the farthest.
struct FarPoints {
  int count = 0;
  std::array<Vector2, 2> points{};    ///< relative to the centre of the shape [L]
  std::array<Vector2, 2> normals{};   ///< unit vectors from the given point to `points` [1]
  std::array<double, 2> distances{};  ///< [L]
};

/// A homogeneous convex shape. Directions and points are along its axes and relative to its centre.
class Shape {
 public:
  /// A disc; the radius [L] is >= 0, and 0 makes it a point.
  static Shape disc(double radius);
  /// A sphere. Its outline, sides and arcs are those of the disc in which a plane through its
  /// centre cuts it.
  static Shape sphere(double radius);
  /// All points at a distance of at most `end_radius` [L] from a spine, a line of the length 2
  /// (half_length - end_radius) along the first axis, with half_length > end_radius > 0.
  static Shape plate(double half_length, double end_radius);
  /// An ellipse with two semi-axes > 0 [L], of which either may be the larger one.
  static Shape ellipse(double first, double second);
  /// `semi_axes` are those of semi_axes().
  Shape(ShapeKind kind, const Vector2& semi_axes);

  ShapeKind kind() const { return kind_; }
  /// [L]; for a disc and a sphere twice the radius, for a plate half_length and end_radius.
  const Vector2& semi_axes() const { return semi_axes_; }
  /// For example `disc` or `plate`.
  std::string_view name() const;
  /// Both semi-axes are multiplied by `factor` > 0.
  Shape scaled(double factor) const { return {kind_, factor * semi_axes_}; }
  /// True if the outline is a circle, so that a turn changes nothing.
  bool is_round() const { return sides() == 0 && arc_at({1, 0}).is_circle(); }

  /// Area [L^2], or volume of a sphere [L^3].
  double measure() const;
  /// Moment of inertia about the centre [M L^2] if the mass is `mass` [M].
  double inertia(double mass) const;
  /// Length of the outline [L].
  double perimeter() const;
  /// Largest distance of a point from the centre [L].
  double bounding_radius() const;
  /// Radius of the largest disc around the centre that is inside the shape [L].
  double inner_radius() const;
  /// The smallest radius of curvature of the outline [L].
  double least_curvature_radius() const;

  /// The point of the outline with the parameter t, which increases by 2 pi once around,
  /// counter-clockwise. For a disc t is the angle from the first axis. For an ellipse with the
  /// semi-axes a, b the point is (a cos t, b sin t). For a plate t is proportional to the length
  /// along the outline from the tip on the first axis.
  OutlinePoint at(double t) const;

  /// Largest value of normal.x among the points x of the shape [L].
  double support(const Vector2& normal) const;
  /// The point of the outline with the given unit normal out of the shape [L]; one end of a side,
  /// if the outline has a side with this normal.
  Vector2 support_point(const Vector2& normal) const;
  /// The arc to which support_point() belongs.
  Arc arc_at(const Vector2& normal) const;
  /// Number of sides.
  int sides() const;
  /// Side k, 0 to sides() - 1.
  Side side(int k) const;
  FarPoints far_points(const Vector2& from) const;
  /// Distance of the point from the outline [L]; < 0 inside.
  double distance_to(const Vector2& point) const;

  bool operator==(const Shape&) const = default;

 private:
  ShapeKind kind_;
  Vector2 semi_axes_;
};

}  // namespace viscontact::particles
