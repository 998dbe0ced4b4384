// The size of the region that a domain and planes, or planes alone, leave to the particles.
#pragma once

#include <span>

#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {

/// Area [L^2] of the region in two dimensions, or its volume [L^3] in three and on an axis. Without
/// a domain the planes must bound it; the result is 0 if they do not, and if nothing is left.
double size_of_region(const Domain& domain, std::span<const PlanePosition> planes, int dimension);

}  // namespace viscontact::particles
