// Outlines of particles in the plane: circles, ellipses, and plates with round ends. Gaps between
// them, and chords at which overlapping discs of a body are cut.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {

/// A circle, an ellipse whose first semi-axis points along `angle`, or a plate with round ends: all
/// points at the distance semi_axes[1] from its spine, a line of the length 2 (semi_axes[0] -
/// semi_axes[1]) through the centre along `angle`. The spine of a circle is its centre.
struct Outline {
  std::array<double, 2> centre{};  ///< [L]
  /// Radius of the circle, or the larger semi-axis of an ellipse or plate [L], > 0.
  double radius = 0;
  /// Semi-axes of an ellipse or plate [L]. Both are equal, for example 0, if it is a circle.
  std::array<double, 2> semi_axes{};
  double angle = 0;       ///< from the x axis to the first semi-axis of an ellipse or plate [rad]
  bool is_plate = false;  ///< whether it is a plate; then semi_axes[0] > semi_axes[1]

  bool is_circle() const { return semi_axes[0] == semi_axes[1]; }
  /// The point [L] of the outline with the parameter t, which increases by 2 pi once around. On a
  /// circle t is the angle from the x axis. On an ellipse with the semi-axes a, b along e_1, e_2
  /// the point is centre + a cos(t) e_1 + b sin(t) e_2. On a plate t is proportional to the length
  /// along the outline from the tip in the direction `angle`.
  std::array<double, 2> at(double t) const;
  /// Length of the derivative of at() by t [L], > 0.
  double speed_at(double t) const;
  /// Radius of curvature at the point at(t) [L]. On an ellipse with the semi-axes a and b it is
  /// (a^2 sin^2 t + b^2 cos^2 t)^(3/2)/(a b). For a plate the radius of its ends is returned, on
  /// the straight sides, too.
  double curvature_radius_at(double t) const;
  /// Radius of the round ends of a plate, or else `radius` [L].
  double end_radius() const { return is_plate ? semi_axes[1] : radius; }
  /// Ends of the spine [L], of which the first lies in the direction `angle`. Both ends are the
  /// centre if the outline is no plate.
  std::array<std::array<double, 2>, 2> spine() const;
  /// Circumference of a circle or plate [L].
  double length() const;
};

struct SpinePoints {
  std::array<double, 2> first{},  ///< on the first spine [L]
      second{};                   ///< on the second spine [L]
  bool cross = false;             ///< whether the spines cross each other
};
/// The nearest points of two spines, of which one is an end of its spine even if the spines cross.
/// Of equally near points, those of the first place (SpineContacts) are returned.
SpinePoints nearest_on_spines(const Outline& first, const Outline& second);

/// The one or two contacts that two outlines, circles or plates, may have. Two plates that lie side
/// by side have two contacts, at both ends of the part where they face each other. An end of a
/// spine and the nearest point of the other spine form a place: the ends of the first spine the
/// places 0 and 1, those of the second spine 2 and 3. The first contact is the place with the
/// shortest distance between its two points. The second contact is the shortest of those places of
/// which both points are further than a tenth of the smaller end radius from those of the first
/// contact; there is none if the spines cross. Each other place belongs to the contact whose points
/// are nearer to its own.
class SpineContacts {
 public:
  SpineContacts(const Outline& first, const Outline& second);
  /// One or two places, 0 to 3.
  const std::vector<int>& places() const { return places_; }
  /// The place of the contact to which `place`, 0 to 3, belongs.
  int contact_of(int place) const { return contact_of_[static_cast<std::size_t>(place)]; }
  /// The points at which the contact of `place` acts after the outlines have moved to `first` and
  /// `second`: those of the place with the shortest distance among all that belong to it.
  SpinePoints at(int place, const Outline& first, const Outline& second) const;

 private:
  std::vector<int> places_;
  std::array<int, 4> contact_of_{};
};

/// Distance of the point x [L] from the outline [L]; < 0 inside.
double distance_to(const Outline& outline, const std::array<double, 2>& x);

/// Distance between two outlines of which neither contains the other [L], exact to rounding errors
/// if one is a circle or both are plates; otherwise found by a search from 128 points of an
/// ellipse. If the outlines overlap, the result is minus the depth to which one reaches into the
/// other: a circle into the other outline, an ellipse into a plate, the ellipse `first` into the
/// ellipse `second`. For plates whose spines cross, it is minus the sum of both end radii.
double gap(const Outline& first, const Outline& second);

/// Distance of the outline from an obstacle [L]; < 0 if a part of the outline is behind the surface
/// of the obstacle. For an ellipse it is found by a search from 128 of its points.
double gap(const PlanePosition& obstacle, const Outline& outline);

/// Outline of particle k in the plane, or of a sphere on the axis with its centre at (0, z).
/// `angles` are those of all particles [rad]; they may be empty if there are no ellipses and
/// plates. `shift` [L] is added to the centre, which gives the outline of a periodic image.
Outline outline_of(const Fluid& fluid, const Particles& particles, std::span<const double> angles,
                   std::size_t k, const Vector& shift = {});

struct Chord {
  std::size_t other = 0;  ///< number of the disc that overlaps it
  // The ends of the chord, at which the circles meet. The arc from `from` to `to`,
  // counter-clockwise, is inside the other disc.
  std::array<double, 2> from{},  ///< end at which the arc begins [L]
      to{};                      ///< end at which the arc ends [L]
  double middle = 0;             ///< angle from the x axis to the middle of this arc [rad]
  double half = 0;               ///< half of the angle of this arc [rad], > 0 and < pi
  double area = 0;               ///< area of the part of the disc beyond the chord [L^2], > 0
  /// Angle between the circles in the fluid outside both, where they meet [rad], > 0 and < pi. The
  /// less the discs overlap, the smaller it is.
  double wedge = 0;
};

/// The chord at which disc `other` cuts disc k; std::nullopt if their circles touch or do not meet.
/// Periodic images are not considered. If k and `other` are exchanged, the chord has the same two
/// ends, bit for bit.
std::optional<Chord> chord_of(const Particles& particles, std::size_t k, std::size_t other);

/// The chords at which other discs of its rigid body cut disc k, in the order of their `middle`,
/// without chords whose arc is within the arc of another chord; none for ellipses and plates, and
/// with RigidConstraint::kPenalty, with which discs may not overlap.
std::vector<Chord> chords_of(const Fluid& fluid, const Particles& particles, std::size_t k);

/// For each particle the sum of Chord::area over its chords_of() [L^2], for Fluid::cut_areas; empty
/// if all sums are 0.
std::vector<double> cut_areas_of(const Fluid& fluid, const Particles& particles);

}  // namespace viscontact::particles
