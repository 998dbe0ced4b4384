// 2 mu D:D of linear flows, and plane Couette flow.
#include "viscontact/freefem_flow/process/dissipation_alone.hpp"

#include <cassert>

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::WallVelocity;

/// 2 D:D [1/T^2] for the symmetric part D of the velocity gradient.
double twice_strain_squared(const particles::LinearFlow& flow) {
  const auto& g = flow.gradient;
  const double shear = (g[1] + g[2]) / 2;
  return 2 * (g[0] * g[0] + 2 * shear * shear + g[3] * g[3]);
}

/// No closed form is valid if the pressure gradient drives fluid along a period of the box.
bool has_driving_pressure(const particles::Fluid& fluid, const BoxDomain* box) {
  if (box == nullptr) return false;
  const auto drives = [&](std::size_t d) {
    return box->periodic[d] && fluid.pressure_gradient[d] != 0;
  };
  return drives(0) || drives(1);
}

/// The square [1/T^2] of the shear rate between two walls at the distance `height` [L] that move
/// along `axis` (0: x, 1: y) with constant velocities. It is 0 if a wall moves in another way.
double shear_rate_squared(const WallVelocity& low, const WallVelocity& high, std::size_t axis,
                          double height) {
  assert(axis < 2);
  const auto moves_along = [&](const WallVelocity& wall) {
    return wall.kind == WallVelocity::Kind::kConstant && !wall.depends_on_time() &&
           wall.value[1 - axis] == 0;
  };
  if (!moves_along(low) || !moves_along(high)) return 0;
  const double rate = (high.value[axis] - low.value[axis]) / height;
  return rate * rate;
}

}  // namespace

double dissipation_alone(const particles::Fluid& fluid, const particles::Domain& domain) {
  const double scale = fluid.viscosity * particles::measure(domain);
  const auto* box = std::get_if<BoxDomain>(&domain);
  if (has_driving_pressure(fluid, box)) return 0;
  if (const auto* flow = std::get_if<particles::LinearFlow>(&fluid.boundary))
    return scale * twice_strain_squared(*flow);
  if (box == nullptr || box->periodic[0] == box->periodic[1]) return 0;
  const std::size_t axis = box->periodic[0] ? 0 : 1;
  const auto& sides = std::get<particles::SideVelocities>(fluid.boundary);
  const std::size_t low = axis == 0 ? 2 : 0;
  return scale * shear_rate_squared(sides[low], sides[low + 1], axis,
                                    box->to[1 - axis] - box->from[1 - axis]);
}

}  // namespace viscontact::freefem_flow
