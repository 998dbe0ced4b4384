// The obstacles of the particles: the walls of the domain, then the planes of the case. Files
// number them -1, -2, ... in this order. Lengths are in the unit of the case.
#pragma once

#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/domain/plane.hpp"

namespace viscontact::particles {

struct Setting;

/// The walls of a domain, at rest, in the order that domain.hpp gives. The wall of a disc is a
/// circle that is seen from inside. The side of a cylinder is parallel to the axis of the
/// particles: its gap is the distance from it, and its normal has no component along the axis.
std::vector<Plane> obstacles_of(const Domain& domain);

/// All obstacles of a case: the walls of its domain, then its planes.
std::vector<Plane> obstacles_of(const Setting& setting);

}  // namespace viscontact::particles
