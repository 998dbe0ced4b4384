// Planes (lines, for discs) that bound the space of the particles. A plane is at rest, moves or
// turns. Lengths and times are in any one consistent system of units.
#pragma once

#include <vector>

#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Position of a plane. The points x with normal.(x - point) >= 0 are its free side.
struct PlanePosition {
  Vector point;   ///< any point of the plane [L]
  Vector normal;  ///< unit normal into the free side
};

/// A plane and its motion: it moves with `velocity` and turns about `pivot`, which moves with it.
/// Only the motion along its normal acts on particles, because viscous contact has no friction.
struct Plane {
  PlanePosition start;         ///< position at time 0
  PiecewiseConstant velocity;  ///< [L/T]
  /// Constant [1/T]; for discs it is (0, 0, omega).
  Vector angular_velocity{};
  Vector pivot{};  ///< position of the pivot at time 0 [L]

  /// Position at time t >= 0 [T].
  PlanePosition at(double t) const;
};

/// Positions of all planes at time t [T], in the order of `planes`.
std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t);

/// Gap D between a sphere and a plane [L], docs/physics.md (5.1); < 0 if they overlap.
inline double gap(const PlanePosition& plane, const Vector& centre, double radius) {
  return dot(plane.normal, centre - plane.point) - radius;
}

}  // namespace viscontact::particles
