// Computes the obstacles and the periodic cell of a setting (setting.hpp). Lengths [L], radii > 0
// among them, velocities of planes [L/T] and the velocity gradient of the cell [1/T] are in the
// units of the case. There may be no obstacle; a cell without periods has the lengths 0. Nothing is
// checked or thrown. A change must keep the order of the obstacles, because files number them in
// this order. Used by the simulations and the files in io/ and run/.
#include "viscontact/particles/setting.hpp"

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

}  // namespace viscontact::particles
