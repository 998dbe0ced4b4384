// Makes obstacles of the walls of a domain. Lengths are in the unit of the case. Nothing is checked
// or thrown. A change must keep the order, which numbers obstacles in files.
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

Plane wall(const PlanePosition& place) {
  Plane plane;
  plane.start = place;
  return plane;
}

std::vector<Plane> walls(std::monostate) { return {}; }

std::vector<Plane> walls(const DiscDomain& disc) { return {wall({disc.centre, {}, disc.radius})}; }

std::vector<Plane> walls(const BoxDomain& box) {
  const Vector from = {box.from[0], box.from[1], 0}, to = {box.to[0], box.to[1], 0};
  std::vector<Plane> planes;
  if (!box.periodic[0]) {
    planes.push_back(wall({from, {1, 0, 0}}));
    planes.push_back(wall({to, {-1, 0, 0}}));
  }
  if (!box.periodic[1]) {
    planes.push_back(wall({from, {0, 1, 0}}));
    planes.push_back(wall({to, {0, -1, 0}}));
  }
  return planes;
}

/// Component 0 of a vector is z and component 1 the distance from the axis, 0 for all particles.
std::vector<Plane> walls(const CylinderDomain& cylinder) {
  return {wall({{0, -cylinder.radius, 0}, {0, 1, 0}}), wall({{0, 0, 0}, {1, 0, 0}}),
          wall({{cylinder.height, 0, 0}, {-1, 0, 0}})};
}

}  // namespace

std::vector<Plane> obstacles_of(const Domain& domain) {
  return std::visit([](const auto& shape) { return walls(shape); }, domain);
}

}  // namespace viscontact::particles
