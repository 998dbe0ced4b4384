// Dissipation of the fluid without particles, which the apparent viscosity refers to, where it has
// a closed form. Lengths, masses and times are in the units of the case; nothing is thrown.
// flow_process.cpp asks it if the solver does not know. A change must keep 0 for "not known".
#pragma once

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"

namespace viscontact::freefem_flow {

/// 2 mu times the integral of D(u):D(u) over the whole domain, for the Stokes flow u without
/// particles and with the same velocities of the walls, per unit length [M L/T³]. It is known
///
/// - for walls or a periodic cell with a linear flow u = E x: 2 mu D:D |domain|, where D is the
///   symmetric part of E;
/// - for a box that is periodic along one axis, whose two walls move along it at constant speeds:
///   plane Couette flow.
///
/// It is 0 otherwise, and if the walls are at rest.
double dissipation_alone(const particles::Fluid& fluid, const particles::Domain& domain);

}  // namespace viscontact::freefem_flow
