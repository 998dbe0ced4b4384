// Computes the obstacles and the periodic cell of a setting (setting.hpp). Lengths [L], among them
// radii > 0, velocities of planes [L/T] and the mean velocity gradient of the cell [1/T] are in the
// units of the case. There may be no obstacle; a cell without periods has the lengths 0. Nothing is
// checked or thrown. A change must keep the order of the obstacles, because files number them in
// this order. The simulations and the files in io/ and run/ use this file.
#include "viscontact/particles/setting.hpp"

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The periodic cell of the domain, with the velocity gradient of the linear flow at the boundary
/// of the fluid, if there is such a flow.
PeriodicCell cell_of(const Setting& setting) {
  auto cell = cell_of(setting.domain);
  if (!setting.fluid) return cell;
  if (const auto* flow = std::get_if<LinearFlow>(&setting.fluid->boundary))
    cell.gradient = flow->gradient;
  return cell;
}

/// All obstacles: first the walls of the domain, then the planes of the setting.
std::vector<Plane> obstacles_of(const Setting& setting) {
  auto obstacles = obstacles_of(setting.domain);
  obstacles.insert(obstacles.end(), setting.planes.begin(), setting.planes.end());
  return obstacles;
}

std::vector<Plane> obstacles_of(const Setting& setting, std::span<const PlaneMotion> motions) {
  auto obstacles = obstacles_of(setting);
  const auto walls = obstacles.size() - setting.planes.size();
  for (std::size_t k = 0; k < motions.size(); ++k) {
    auto& plane = obstacles[walls + k];
    plane.start.point = plane.start.point + motions[k].displacement * plane.start.normal;
  }
  return obstacles;
}

}  // namespace viscontact::particles
