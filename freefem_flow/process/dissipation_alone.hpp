// Computes the dissipation of the fluid without particles, if it has a closed form. The apparent
// viscosity is the dissipation with particles divided by this one. Units are those of the
// arguments; nothing is checked or thrown. flow_process.cpp uses the result if the fluid solver
// does not know this dissipation, and membranes/membrane_process.cpp always. A change must keep
// that the result 0 means "not known".
#pragma once

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"

namespace viscontact::freefem_flow {

/// The dissipation of the Stokes flow u of viscosity mu [M/(L T)] > 0 without particles, with the
/// velocities of the walls that `fluid` gives: 2 mu times the integral of D(u):D(u) over the whole
/// domain, >= 0. D(u) is the symmetric part of the gradient of u [1/T]. In a disc or box the
/// dissipation is per unit length of the third dimension [M L/T³], in a cylinder it is in
/// [M L²/T³]. A closed form is known
///
/// - for a linear flow u = E x with a constant matrix E, which walls or a cell that is periodic
///   along both axes prescribe: 2 mu D:D times the area or volume of the domain;
/// - for a box that is periodic along one axis, whose two walls move along this axis at constant
///   speeds that do not depend on time: plane Couette flow.
///
/// Otherwise the result is 0. In the two cases of the list it is 0, too, if a pressure gradient
/// drives fluid along a period, if the walls are at rest, or if the linear flow is a rotation.
double dissipation_alone(const particles::Fluid& fluid, const particles::Domain& domain);

}  // namespace viscontact::freefem_flow
