// The opening, which is the first text that a fluid solver gets: the fluid, the domain and the
// sizes of the particles, in the units of the arguments. flow_process.cpp and
// membranes/membrane_process.cpp send it. A change must agree with docs/fluid-solver.md and with
// scripts/opening.idp, which reads it.
#pragma once

#include <span>
#include <string>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// The text of the opening. `radii`: of all particles [L], > 0. `dimension`: 2 in the
/// plane, 1 on the axis of a cylinder. Throws Error(kBadInput) if there is no domain, if the domain
/// is a cylinder in the plane or none on the axis, or if `fluid` gives velocities of single sides
/// for a domain that is not a box.
std::string opening(const particles::Fluid& fluid, const particles::Domain& domain,
                    std::span<const double> radii, int dimension);

/// The velocities of all walls at the time of `step`, one line for each wall in the order of the
/// opening: the eight numbers A0 AX AY B0 BX BY P Q of docs/fluid-solver.md.
std::string walls_at(const particles::Fluid& fluid, const particles::Domain& domain,
                     const particles::FlowStep& step);

}  // namespace viscontact::freefem_flow
