// Computes the position of a plane at a given time: a rotation about its pivot, then a translation
// (plane.hpp). Numbers are in any consistent units. Nothing is checked or thrown. A change must
// keep a plane at rest bit for bit.
#include "viscontact/particles/domain/plane.hpp"

#include <cmath>

namespace viscontact::particles {
namespace {

/// Vector `a` turned by `angle` [rad] about the unit vector `axis` (Rodrigues' formula).
Vector turned(const Vector& a, const Vector& axis, double angle) {
  const double c = std::cos(angle);
  return c * a + std::sin(angle) * cross(axis, a) + (1 - c) * dot(axis, a) * axis;
}

}  // namespace

PlanePosition Plane::at(double t) const {
  PlanePosition place = start;
  if (const double speed = norm(angular_velocity); speed > 0 && t > 0) {
    const Vector axis = (1 / speed) * angular_velocity;
    place.point = pivot + turned(start.point - pivot, axis, speed * t);
    place.normal = turned(start.normal, axis, speed * t);
  }
  place.point = place.point + velocity.integral(t);
  return place;
}

Vector Plane::displacement(const Vector& point, double from, double to) const {
  const Vector shift = velocity.integral(to) - velocity.integral(from);
  const double speed = norm(angular_velocity);
  if (!(speed > 0)) return shift;
  const Vector arm = point - pivot - velocity.integral(to);
  const Vector axis = (1 / speed) * angular_velocity;
  return shift + arm - turned(arm, axis, speed * (from - to));
}

Vector Plane::surface_velocity(const Vector& point, double t) const {
  return velocity.value(t) + cross(angular_velocity, point - pivot - velocity.integral(t));
}

std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t) {
  std::vector<PlanePosition> places;
  for (const auto& plane : planes) places.push_back(plane.at(t));
  return places;
}

}  // namespace viscontact::particles
