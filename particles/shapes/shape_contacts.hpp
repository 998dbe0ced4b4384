// The places at which two surfaces in the plane make contact, and their gaps, normals and arms.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/shapes/distance.hpp"

namespace viscontact::particles {

/// The contact of two surfaces, as that of the two circles that have the tangents and the radii of
/// curvature of the surfaces at their nearest points. At an obstacle, which is the first surface,
/// the members of the first circle are 0.
struct SurfaceContact {
  double gap = 0;                 ///< distance of the surfaces [L]; < 0 if they overlap
  Vector2 normal{};               ///< unit normal, from the first surface to the second
  std::array<Vector2, 2> arms{};  ///< centres of the circles from those of the shapes [L]
  std::array<double, 2> radii{};  ///< of the circles [L], >= 0
  double distance = 0;            ///< of the centres of both circles [L], >= 0
  bool is_at_obstacle = false;
  Vector2 on_obstacle{};  ///< the nearest point of the obstacle [L]

  /// Change of the gap per counter-clockwise turn [rad] of both shapes [L].
  std::array<double, 2> levers() const { return {-cross(arms[0], normal), cross(arms[1], normal)}; }
  /// Distances of the point at which friction acts from the centres of both shapes, along the
  /// normal [L]. It is one point in the gap, so that friction keeps the angular momentum.
  std::array<double, 2> friction_arms() const;
};

/// The arcs of a rounded shape: all points at most `radius` from a point, a line or a polygon. Disc
/// and plate are rounded shapes, an ellipse is none.
struct Core {
  double radius = 0;  ///< [L]
  /// The corners, counter-clockwise [L]; empty if the shape is not rounded.
  std::vector<Vector2> corners{};
};
Core core_of(const PlacedShape& shape);

/// Distance of two shapes [L]; < 0 if they overlap. For rounded shapes whose cores are lines that
/// cross, it is minus the sum of both radii.
double gap(const PlacedShape& first, const PlacedShape& second);

/// Distance of a shape from an obstacle [L]; < 0 if a part of the shape is behind its surface.
double gap(const PlanePosition& obstacle, const PlacedShape& shape);

/// The one or two contacts of two shapes. Two rounded shapes that lie side by side have two
/// contacts, at both ends of the part where they face each other. A corner of a core and the
/// nearest point of the other core form a place: those of the corners of the first core have the
/// numbers from 0, then come those of the second core. The first contact is the place with the
/// shortest distance between its two points. The second contact is the shortest of those places of
/// which both points are further than a tenth of the smaller radius from those of the first
/// contact; there is none if the cores overlap. Each other place belongs to the contact whose
/// points are nearer to its own. Shapes of which one is not rounded, or is a disc, have one contact
/// with the number 0.
class ShapeContacts {
 public:
  /// The contacts at the present places of the shapes.
  ShapeContacts(const PlacedShape& first, const PlacedShape& second);
  /// The numbers of the contacts, one or two.
  std::span<const int> places() const { return {places_.data(), count_}; }
  /// The contact to which `place`, a number of earlier places, belongs now.
  int contact_of(int place) const;
  /// The contact `place` after the shapes have moved to `first` and `second`: the one with the
  /// shortest distance among all places that belong to it.
  SurfaceContact at(int place, const PlacedShape& first, const PlacedShape& second) const;

 private:
  std::array<int, 2> places_{};
  std::size_t count_ = 1;
  std::vector<int> contact_of_{};  // empty: all places belong to the contact 0
  Vector2 normal_{};               // a guess; not used for rounded shapes
};

/// The contacts of a shape with an obstacle, a straight or a round wall. A rounded shape has one
/// for each corner of its core. Other shapes have one at a straight wall, and one or two in a round
/// one: number 0 at the end of the longer axis to which its direction points, number 1 at the other
/// end.
class WallContacts {
 public:
  WallContacts(const PlanePosition& obstacle, const PlacedShape& shape);
  std::span<const int> places() const { return places_; }
  int contact_of(int place) const;
  SurfaceContact at(int place, const PlanePosition& obstacle, const PlacedShape& shape) const;

 private:
  std::vector<int> places_;
};

}  // namespace viscontact::particles
