// The first text that a fluid solver gets: the fluid, the domain and the sizes of the particles
// (docs/fluid-solver.md).
#pragma once

#include <span>
#include <string>

#include "viscontact/particles/fluid.hpp"

namespace viscontact::freefem_flow {

/// The opening of the protocol. `dimension`: 2 in the plane, 1 on the axis of a cylinder. Throws
/// Error(kBadInput) if there is no domain, if it does not belong to the dimension, or if velocities
/// of single sides are given for a domain that is not a box.
std::string opening(const particles::Fluid& fluid, const particles::Domain& domain,
                    std::span<const double> radii, int dimension);

}  // namespace viscontact::freefem_flow
