// Planes (lines, for discs) that bound the particles' room: at rest, sliding or turning.
#pragma once

#include <vector>

#include "viscontact/particles/piecewise_constant.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// Where a plane is: x with normal.(x - point) >= 0 is the free side.
struct PlanePosition {
  Vector point;   ///< [L]
  Vector normal;  ///< unit, into the free side
};

/// A plane and its motion: it moves with `velocity` and turns about `pivot`, which moves with it. Viscous contact has no friction: of the motion
/// only what is normal to the plane acts on a particle.
struct Plane {
  PlanePosition start;         ///< at time 0
  PiecewiseConstant velocity;  ///< [L/T]
  Vector angular_velocity{};   ///< constant [1/T]; for discs (0, 0, omega)
  Vector pivot{};              ///< at time 0 [L]

  /// At time t >= 0.
  PlanePosition at(double t) const;
};

/// Those of planes at time t, in their order.
std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t);

/// Distance of a sphere's surface from the plane [L], < 0 if they overlap: physics.md (5), D of a plane.
inline double gap(const PlanePosition& plane, const Vector& centre, double radius) {
  return dot(plane.normal, centre - plane.point) - radius;
}

}  // namespace viscontact::particles
