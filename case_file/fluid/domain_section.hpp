// The section [domain] of a case of many particles (docs/case-file.md): a disc, a box or a cylinder
// that holds the particles and the fluid. Lengths are in the unit of the case.
#pragma once

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::case_file {

/// Reads [domain]. `dimension` is that of the case: 1 (spheres on an axis), 2 or 3.
///
/// Throws Error(kBadInput) with file, line and key for a wrong value; if not exactly one shape is
/// given; and for a shape that does not belong to the dimension: discs move in a disc or a box,
/// spheres on an axis in a cylinder, and no domain has dimension 3.
particles::Domain read_domain(const TomlSection& section, int dimension);

}  // namespace viscontact::case_file
