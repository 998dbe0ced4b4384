// The outline of a particle in the plane: a circle, an ellipse, or a plate with round ends; and
// that of a rigid body in a fluid whose discs overlap, which is their union: each disc is cut along
// the chords at which its circle meets those of the others, so that the cut discs cover the union
// once. Lengths are in the unit of the case, angles in radians, counter-clockwise. Checks of a
// case, the fluid and its meshes use it. Nothing is checked or thrown. A change must keep a circle
// exact, and the sum of what is left of the discs that of the union.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {

/// A circle, an ellipse whose first semi-axis points along `angle`, or a plate with round ends: all
/// points at the distance semi_axes[1] from its spine, a line of the length 2 (semi_axes[0] -
/// semi_axes[1]) through the centre along `angle`. The spine of a circle is its centre.
struct Outline {
  std::array<double, 2> centre{};  ///< [L]
  /// Of the circle, or the larger semi-axis of the ellipse: that of the circle around it [L], > 0.
  double radius = 0;
  std::array<double, 2> semi_axes{};  ///< of an ellipse [L], > 0; equal to each other: a circle
  double angle = 0;       ///< of the first semi-axis of an ellipse or plate with the x axis
  bool is_plate = false;  ///< whether it is a plate; then semi_axes[0] > semi_axes[1]

  /// True if it is a circle of the radius `radius`.
  bool is_circle() const { return semi_axes[0] == semi_axes[1]; }
  /// The point centre + a cos(t) e_1 + b sin(t) e_2, with the directions e_1, e_2 of the semi-axes
  /// a, b [L]. On a circle t is the angle from the x axis. On a plate t goes evenly along the
  /// outline, from the point at the end along `angle`.
  std::array<double, 2> at(double t) const;
  /// Length of the derivative of at() [L].
  double speed_at(double t) const;
  /// Radius of the circle that touches the outline best at at(t) [L]: (a^2 sin^2 t + b^2 cos^2
  /// t)^(3/2)/(a b).
  double curvature_radius_at(double t) const;
  /// The radius of a circle, or that of the round ends of a plate [L].
  double end_radius() const { return is_plate ? semi_axes[1] : radius; }
  /// The ends of the spine of a plate, the first one along `angle`; of a circle both are its
  /// centre.
  std::array<std::array<double, 2>, 2> spine() const;
  /// Length of the outline [L] of a circle or plate.
  double length() const;
};

/// Points of the spines of two outlines, circles or plates.
struct SpinePoints {
  std::array<double, 2> first{},  ///< on the first spine [L]
      second{};                   ///< on the second spine [L]
  bool cross = false;             ///< whether the spines cross each other
};
/// The points that are nearest to each other. Of several such pairs it is the first one in the
/// order of the ends.
SpinePoints nearest_on_spines(const Outline& first, const Outline& second);

/// The one or two contacts that two outlines, circles or plates, may have. Each end of a spine and
/// the point of the other spine that is nearest to it are a place where both may touch; the places
/// have the numbers 0 and 1 of the ends of the first spine, and 2 and 3 of those of the second one.
/// The nearest place is a contact. Another contact is the nearest place of which neither point is
/// within a tenth of the smaller end radius of those of the first contact, so that it keeps the
/// other ends apart where plates lie on each other. Each further place belongs to the contact that
/// is nearer to it.
class SpineContacts {
 public:
  /// Of both outlines as they are now.
  SpineContacts(const Outline& first, const Outline& second);
  /// The place of each contact, one or two.
  const std::vector<int>& places() const { return places_; }
  /// The place of the contact to which the place `place` belongs.
  int contact_of(int place) const { return contact_of_[static_cast<std::size_t>(place)]; }
  /// The points of the contact to which the place `place` belongs, when the outlines have become
  /// `first` and `second`: of all its places the nearest one.
  SpinePoints at(int place, const Outline& first, const Outline& second) const;

 private:
  std::vector<int> places_;
  std::array<int, 4> contact_of_{};
};

/// Distance of a point from the outline [L]; < 0 inside.
double distance_to(const Outline& outline, const std::array<double, 2>& x);

/// Distance between two outlines of which neither is in the other [L]; <= 0 if they overlap, and
/// then it is the depth of the deepest point of `first` in `second`.
double gap(const Outline& first, const Outline& second);

/// Distance of the outline from an obstacle [L]; < 0 if a part of it is behind the obstacle.
double gap(const PlanePosition& obstacle, const Outline& outline);

/// Outline of particle k in the plane, or of a sphere on the axis, which is at (0, z). `angles`: of
/// all particles [rad]; used for ellipses only. `shift` [L] moves it to an image.
Outline outline_of(const Fluid& fluid, const Particles& particles, std::span<const double> angles,
                   std::size_t k, const Vector& shift = {});

/// How a disc is cut by one that overlaps it.
struct Chord {
  std::size_t other = 0;  ///< number of the disc that overlaps it
  // The ends of the chord, at which the circles meet. The arc from `from` to `to`,
  // counter-clockwise, is inside the other disc.
  std::array<double, 2> from{},  ///< first end [L]
      to{};                      ///< last end [L]
  double middle = 0;             ///< angle of the middle of this arc with the x axis [rad]
  double half = 0;               ///< half of the angle of this arc [rad], > 0 and < pi
  double area = 0;               ///< of the disc beyond the chord [L^2]
  /// Angle of the wedge of fluid where the circles meet [rad], > 0 and < pi: the smaller, the more
  /// shallow the overlap.
  double wedge = 0;
};

/// The chord at which the disc `other` cuts the disc k; none if their circles do not meet. Both
/// must not be images of each other. The ends of the chord are the same numbers for both discs.
std::optional<Chord> chord_of(const Particles& particles, std::size_t k, std::size_t other);

/// The chords at which discs of its body cut disc k in this fluid, by their angle `middle` from -pi
/// to pi, without those whose arc is within that of another one. None if particle k is an ellipse
/// or plate, which have no chords, and by penalty, where discs may not overlap.
std::vector<Chord> chords_of(const Fluid& fluid, const Particles& particles, std::size_t k);

/// Fluid::cut_areas for these particles [L^2]: of each one the sum of the areas beyond its chords.
std::vector<double> cut_areas_of(const Fluid& fluid, const Particles& particles);

}  // namespace viscontact::particles
