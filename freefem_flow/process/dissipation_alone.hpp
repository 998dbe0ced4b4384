// The dissipation of the fluid without particles, if it has a closed form.
#pragma once

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

/// The dissipation of the Stokes flow u without particles, with the velocities of the walls that
/// `fluid` gives: 2 mu times the integral of D(u):D(u) over the whole domain, >= 0. In a disc or
/// box it is per unit length of the third dimension [M L/T³], in a cylinder [M L²/T³]. A closed
/// form is known
///
/// - for a linear flow u = E x with a constant matrix E, which walls or a cell that is periodic
///   along both axes prescribe: 2 mu D:D times the area or volume of the domain;
/// - for a box that is periodic along one axis, whose two walls move along this axis at constant
///   speeds that do not depend on time: plane Couette flow.
///
/// Otherwise the result is exactly 0. In the two cases of the list it is 0, too, if a pressure
/// gradient drives fluid along a period, if the walls are at rest, or if the flow is a rotation.
double dissipation_alone(const particles::Fluid& fluid, const particles::Domain& domain);

}  // namespace viscontact::freefem_flow
