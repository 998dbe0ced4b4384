// The part of a domain that planes leave free.
#pragma once

#include <span>

#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {

/// Area [L^2] of a disc or rectangle, or volume [L^3] of a cuboid or cylinder, without the parts
/// behind `planes`. Planes have unit normals and any direction; circles among them are left out.
/// The result is 0 without a domain, and if nothing is left.
double measure(const Domain& domain, std::span<const PlanePosition> planes);

}  // namespace viscontact::particles
