// The first text that a fluid solver gets: the fluid, the domain and the sizes of the particles
// (docs/fluid-solver.md, which a change must follow), in the units of the arguments.
// flow_process.cpp sends it.
#pragma once

#include <span>
#include <string>

#include "viscontact/particles/fluid.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {

/// The opening of the protocol. `dimension`: 2 in the plane, 1 on the axis of a cylinder. Throws
/// Error(kBadInput) if there is no domain, if it does not belong to the dimension, or if velocities
/// of single sides are given for a domain that is not a box.
std::string opening(const particles::Fluid& fluid, const particles::Domain& domain,
                    std::span<const double> radii, int dimension);

/// The velocities of all walls at the time of `step`: eight numbers for each wall, in the order of
/// the opening.
std::string walls_at(const particles::Fluid& fluid, const particles::Domain& domain,
                     const particles::FlowStep& step);

}  // namespace viscontact::freefem_flow
