// Motion of planes, and sizes and walls of domains.
#include "viscontact/particles/domain/domain.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace viscontact::particles {
namespace {

/// Vector `a` turned by `angle` [rad] about the unit vector `axis` (Rodrigues' formula).
Vector rotated_about(const Vector& a, const Vector& axis, double angle) {
  const double c = std::cos(angle);
  return c * a + std::sin(angle) * cross(axis, a) + (1 - c) * dot(axis, a) * axis;
}

}  // namespace

PlanePosition Plane::at(double t) const {
  PlanePosition place = start;
  if (const double speed = norm(angular_velocity); speed > 0 && t > 0) {
    const Vector axis = (1 / speed) * angular_velocity;
    place.point = pivot + rotated_about(start.point - pivot, axis, speed * t);
    place.normal = rotated_about(start.normal, axis, speed * t);
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
  return shift + arm - rotated_about(arm, axis, speed * (from - to));
}

Vector Plane::surface_velocity(const Vector& point, double t) const {
  return velocity.value(t) + cross(angular_velocity, point - pivot - velocity.integral(t));
}

Vector distant_corner(const Domain& domain) {
  Vector corner{};
  double size = 0;  // [L]
  if (const auto* disc = std::get_if<DiscDomain>(&domain)) {
    size = 2 * disc->radius;
    corner = {disc->centre[0] - disc->radius, disc->centre[1] - disc->radius, 0};
  } else if (const auto* box = std::get_if<BoxDomain>(&domain)) {
    corner = box->from;
    for (std::size_t d = 0; d < box->dimension(); ++d)
      size = std::max(size, box->to[d] - box->from[d]);
  }
  // Boxes that begin within some sizes of the origin, as most do, are not changed. Rounding errors
  // in them are at most some hundred times those in a box at the origin.
  constexpr double kDistant = 100;
  for (auto& x : corner)
    if (!(std::abs(x) > kDistant * size)) x = 0;
  return corner;
}

std::vector<PlanePosition> positions_of(const std::vector<Plane>& planes, double t) {
  std::vector<PlanePosition> places;
  for (const auto& plane : planes) places.push_back(plane.at(t));
  return places;
}

namespace {

Plane wall(const PlanePosition& place) {
  Plane plane;
  plane.start = place;
  return plane;
}

// The functions walls() return the walls of a domain in the order of their numbers in files. The
// walls of a box are, along each axis that is not periodic, the side with the smallest coordinate
// and then the side with the largest one.

std::vector<Plane> walls(std::monostate) { return {}; }

std::vector<Plane> walls(const DiscDomain& disc) { return {wall({disc.centre, {}, disc.radius})}; }

std::vector<Plane> walls(const BoxDomain& box) {
  std::vector<Plane> planes;
  for (std::size_t d = 0; d < box.dimension(); ++d) {
    if (box.periodic[d]) continue;
    Vector inward{}, outward{};
    inward[d] = 1;
    outward[d] = -1;
    planes.push_back(wall({box.from, inward}));
    planes.push_back(wall({box.to, outward}));
  }
  return planes;
}

/// The walls are the side, the floor and the lid. Component 0 of a vector is the coordinate z along
/// the axis, and component 1 the distance from the axis, which is 0 for all particles.
std::vector<Plane> walls(const CylinderDomain& cylinder) {
  return {wall({{0, -cylinder.radius, 0}, {0, 1, 0}}), wall({{0, 0, 0}, {1, 0, 0}}),
          wall({{cylinder.height, 0, 0}, {-1, 0, 0}})};
}

}  // namespace

double measure(const Domain& domain) {
  using std::numbers::pi;
  if (const auto* disc = std::get_if<DiscDomain>(&domain)) return pi * disc->radius * disc->radius;
  if (const auto* cylinder = std::get_if<CylinderDomain>(&domain))
    return pi * cylinder->radius * cylinder->radius * cylinder->height;
  const auto* box = std::get_if<BoxDomain>(&domain);
  if (box == nullptr) return 0;
  const double area = (box->to[0] - box->from[0]) * (box->to[1] - box->from[1]);
  return box->dimension() == 2 ? area : area * (box->to[2] - box->from[2]);
}

std::vector<Plane> obstacles_of(const Domain& domain) {
  return std::visit([](const auto& shape) { return walls(shape); }, domain);
}

}  // namespace viscontact::particles
