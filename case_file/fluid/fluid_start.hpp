// What a case of particles in a fluid needs at its start, beyond what its sections say one by one.
// Lengths are in the unit of the case.
#pragma once

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/particles/particles_start.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// Sets the default of fluid.threshold_gap: 0.05 times the smallest radius, or half of the smallest
/// gap at the start, also between a particle and its own image, if this is smaller; but at least
/// the gap 2 s at which the solids of particles of roughness s touch. `c` has a fluid, and
/// check_start() has accepted it.
void set_default_threshold_gap(ParticlesCase& c);

/// Throws Error(kBadInput), with file and line, if the flow cannot be computed: no wall, period or
/// driven particle that can take up the forces on the particles; particles without mass with the
/// splitting, whose projection is in the norm of the masses; a gap that is less than a thousandth
/// of the radius, which the fitted mesh does not resolve; a threshold gap below that at which the
/// solids touch; and a gap that is smaller than the threshold gap by more than solver.tolerance
/// mean radii, so that contact would be made before the start.
///
/// `root` is the root table of the case; `c` has a fluid, and check_start() has accepted it.
void check_fluid_start(const TomlSection& root, const ParticlesCase& c, const ParticleLines& lines);

}  // namespace viscontact::case_file
