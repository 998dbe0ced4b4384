// The section [arrangement] of a case of many particles (docs/case-file.md): random discs in the
// domain of the case. Lengths and masses are in the units of the case.
#pragma once

#include "viscontact/case_file/toml_section.hpp"
#include "viscontact/particles/arrangement/arrangement.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/particles.hpp"

namespace viscontact::case_file {

/// Reads [arrangement] and adds its discs to `p`, whose present particles keep their places. The
/// new discs are at rest. Returns what the section asks for. `has_fluid` says whether the case has
/// a fluid: then the mass is 0 unless it is given, and the discs get an angle and a moment of
/// inertia.
///
/// Throws Error(kBadInput) with file, line and key for a wrong value, for a domain that is no disc
/// or box, and if the discs do not fit.
particles::Arrangement read_arrangement(const TomlSection& section, const particles::Domain& domain,
                                        bool has_fluid, particles::Particles& p);

}  // namespace viscontact::case_file
