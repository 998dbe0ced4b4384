// Planes (lines, for discs) and circles that bound the space of the particles. A plane is at rest,
// moves or turns. Lengths and times are in any consistent units. All contacts use them;
// particles/case checks the values. A change must keep normals at length 1.
#pragma once

#include <vector>

#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Position of a plane. The points x with normal.(x - point) >= 0 are its free side. With a radius
/// it is a circle, whose inside |x - point| <= radius is the free side; then `normal` is not used.
struct PlanePosition {
  Vector point;       ///< any point of the plane, or the centre of the circle [L]
  Vector normal;      ///< unit normal into the free side
  double radius = 0;  ///< of the circle [L], > 0; 0: a plane

  bool is_curved() const { return radius > 0; }  ///< whether it is a circle
  /// True if all members are equal.
  bool operator==(const PlanePosition&) const = default;
};

/// A plane and its motion: it moves with `velocity` and turns about `pivot`, which moves with it.
/// Without friction only the motion along its normal acts on particles.
struct Plane {
  PlanePosition start;         ///< position at time 0
  PiecewiseConstant velocity;  ///< [L/T]
  /// Angular velocity, which is constant [1/T]; for discs (0, 0, omega).
  Vector angular_velocity{};
  Vector pivot{};  ///< position of the pivot at time 0 [L]

  /// Position at time t >= 0 [T].
  PlanePosition at(double t) const;
  /// Displacement, between the times `from` and `to` [T], of the material point of the plane that
  /// is at `point` at time `to` [L].
  Vector displacement(const Vector& point, double from, double to) const;
  /// Velocity at time `t` [T] of the material point of the plane that is then at `point` [L/T].
  Vector surface_velocity(const Vector& point, double t) const;
};

/// Positions of all planes at time t [T], in the order of `planes`.
std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t);

/// Gap D between a sphere and a plane, or a circle around it [L], docs/physics.md (5.1); < 0 if
/// they overlap.
inline double gap(const PlanePosition& plane, const Vector& centre, double radius) {
  if (plane.is_curved()) return plane.radius - norm(centre - plane.point) - radius;
  return dot(plane.normal, centre - plane.point) - radius;
}

/// Unit normal, into the free side, at the point of the plane or circle that is nearest to
/// `centre`. In the centre of a circle the normal is the first axis.
inline Vector normal_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane.normal;
  const Vector inward = plane.point - centre;
  const double distance = norm(inward);
  return distance > 0 ? (1 / distance) * inward : Vector{1, 0, 0};
}

/// The plane that touches the circle at its point nearest to `centre`; a plane is returned as it
/// is. The inside of the circle lies in its free side.
inline PlanePosition tangent_at(const PlanePosition& plane, const Vector& centre) {
  if (!plane.is_curved()) return plane;
  const Vector normal = normal_at(plane, centre);
  return {plane.point - plane.radius * normal, normal};
}

}  // namespace viscontact::particles
