// Measures domains, and makes obstacles of their walls. Lengths are in the unit of the case.
// Nothing is checked or thrown. A change must keep the order of the walls, by which files number
// obstacles.
#include "viscontact/particles/domain/domain.hpp"

#include <numbers>

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

/// Component 0 of a vector is z and component 1 the distance from the axis, 0 for all particles.
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
