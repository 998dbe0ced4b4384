// Computes the dissipation of the fluid without particles, >= 0, in closed form, for linear flows
// and plane Couette flow: in a disc or box per unit length of the third dimension [M L/T^3], in a
// cylinder [M L^2/T^3]. process/flow_process.cpp and membranes/membrane_process.cpp use this file.
// Numbers are in the units of the arguments. The viscosity [M/(L T)] and the lengths must be
// positive, which is not checked; nothing is thrown. A change must keep that the result is exactly
// 0 if no closed form is known, because callers take 0 for "not known".
#include "viscontact/freefem_flow/process/dissipation_alone.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::WallVelocity;

/// 2 D:D [1/T^2] for the symmetric part D of the velocity gradient (g0, g1; g2, g3) [1/T].
double twice_strain_squared(const particles::LinearFlow& flow) {
  const auto& g = flow.gradient;
  const double shear = (g[1] + g[2]) / 2;
  return 2 * (g[0] * g[0] + 2 * shear * shear + g[3] * g[3]);
}

/// True if the pressure gradient drives fluid along a period of the box: no closed form below is
/// valid then. Without a box (null) it is false.
bool has_driving_pressure(const particles::Fluid& fluid, const BoxDomain* box) {
  if (box == nullptr) return false;
  const auto drives = [&](std::size_t d) {
    return box->periodic[d] && fluid.pressure_gradient[d] != 0;
  };
  return drives(0) || drives(1);
}

/// The square [1/T^2] of the shear rate between two walls at the distance `height` [L] > 0 that
/// move along the axis `axis` (0: x, 1: y) with constant velocities. It is 0 if a wall moves in
/// another way, or if its velocity depends on time.
double shear_rate_squared(const WallVelocity& low, const WallVelocity& high, std::size_t axis,
                          double height) {
  const auto moves_along = [&](const WallVelocity& wall) {
    return wall.kind == WallVelocity::Kind::kConstant && !wall.depends_on_time() &&
           wall.value[1 - axis] == 0;
  };
  if (!moves_along(low) || !moves_along(high)) return 0;
  const double rate = (high.value[axis] - low.value[axis]) / height;
  return rate * rate;
}

}  // namespace

/// Returns the viscosity times the area or volume of the domain times the square of a rate [1/T^2]:
/// 2 D:D in a linear flow, and the squared shear rate between the two walls of a box that is
/// periodic along these walls. Returns 0 if a pressure gradient drives the fluid, and in all other
/// cases, for example with open or parabolic sides.
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
