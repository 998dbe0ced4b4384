// The opening, the first text that a fluid solver gets (docs/fluid-solver.md; scripts/opening.idp
// reads it): the fluid, the domain and the sizes of the particles.
#pragma once

#include <span>
#include <string>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

/// The text of the opening, with numbers that read back to the same double. `shapes` are those of
/// all particles; `dimension` is 2 in the plane, 1 on the axis of a cylinder. Throws
/// Error(kBadInput) if there is no domain, if the domain is a cylinder in the plane or not a
/// cylinder on the axis, or if `fluid` gives velocities of single sides for a domain that is not a
/// box.
std::string opening(const particles::Fluid& fluid, const particles::Domain& domain,
                    std::span<const particles::Shape> shapes, int dimension);

/// The request with the pressure gradient that drives a Stokes flow; empty if there is none, and in
/// a fluid with inertia, whose requests `place` have it.
std::string gradient_request(const particles::Fluid& fluid);

/// The velocities of all walls at the time of `step`, one line for each wall in the order of the
/// opening, with the eight numbers A0 AX AY B0 BX BY P Q of docs/fluid-solver.md. With q = 4 s (1 -
/// s), where s goes from 0 to 1 along the side of a box, the velocity at (x, y) is (A0 + AX x + AY
/// y + P q, B0 + BX x + BY y + Q q); all are 0 for an open side.
std::string walls_at(const particles::Fluid& fluid, const particles::Domain& domain,
                     const particles::FlowStep& step);

}  // namespace viscontact::freefem_flow
