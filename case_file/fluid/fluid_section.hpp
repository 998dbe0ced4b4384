// The section [fluid] of a case of many particles (docs/case-file.md): the fluid, the velocity of
// its boundary, and how the flow is computed. Lengths, masses and times are in the units of the
// case.
#pragma once

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/fluid.hpp"

namespace viscontact::case_file {

/// Reads [fluid]. `domain` holds the fluid and must not be empty. If the section does not give
/// threshold_gap, it is 0 in the result, and the caller sets its default, which depends on the
/// particles.
///
/// Throws Error(kBadInput) with file, line, key and what is allowed for a wrong value; for a
/// density, because only Stokes flow is possible; for rigid motions as unknowns on a mesh that does
/// not know the particles; and for a velocity of the boundary that does not fit the domain: a shear
/// or strain that is not the same on both sides of a period, an entry for a side that is periodic,
/// a net flux through walls without an open side, and any velocity of the walls of a cylinder.
particles::Fluid read_fluid(const TomlSection& section, const particles::Domain& domain);

}  // namespace viscontact::case_file
