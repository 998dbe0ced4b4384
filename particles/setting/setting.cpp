// Obstacles and the periodic cell of a setting.
#include "viscontact/particles/setting/setting.hpp"

#include <cassert>

#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

PeriodicCell cell_of(const Setting& setting) {
  auto cell = cell_of(setting.domain);
  if (!setting.fluid) return cell;
  if (const auto* flow = std::get_if<LinearFlow>(&setting.fluid->boundary))
    cell.gradient = flow->gradient;
  return cell;
}

std::vector<Plane> obstacles_of(const Setting& setting) {
  auto obstacles = obstacles_of(setting.domain);
  obstacles.insert(obstacles.end(), setting.planes.begin(), setting.planes.end());
  return obstacles;
}

std::vector<Plane> obstacles_of(const Setting& setting, std::span<const PlaneMotion> motions) {
  assert(motions.size() <= setting.planes.size());
  auto obstacles = obstacles_of(setting);
  const auto walls = obstacles.size() - setting.planes.size();
  for (std::size_t k = 0; k < motions.size(); ++k) {
    auto& plane = obstacles[walls + k];
    plane.start.point = plane.start.point + motions[k].displacement * plane.start.normal;
  }
  return obstacles;
}

}  // namespace viscontact::particles
