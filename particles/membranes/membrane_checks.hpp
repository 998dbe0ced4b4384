// Checks of the sections [[membrane]] of a case. All functions throw Error(kBadInput) with the line
// of the case. For membrane_keys.cpp only. Lengths are in the unit of the case.
#pragma once

#include "viscontact/particles/case/particles_sections.hpp"

namespace viscontact::particles {

/// Throws if the case has what cannot be computed together with membranes. `first` is the section
/// of the first membrane.
void check_case_of_membranes(const case_file::TomlSection& root,
                             const case_file::TomlSection& first, const ParticlesCase& c);

/// Throws if the given beads of a new membrane are too few, if one is named twice or belongs to
/// another membrane, or if one has a given motion or, in a fluid, a mass.
void check_given_beads(const case_file::TomlSection& section, const ParticlesCase& c,
                       const Membrane& membrane);

/// Throws if the last membrane crosses itself, if beads of it that are no neighbours overlap, or if
/// it crosses another membrane or an image of it in the next period. In a fluid it also throws if
/// one of two membranes contains the other.
void check_place(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if the fluid inside the last membrane is much less or much more viscous than outside, or
/// if the membrane is too stiff for its number of beads. The case has a fluid.
void check_in_fluid(const case_file::TomlSection& section, const ParticlesCase& c);

/// Throws if a case with a fluid has, beside the beads of its membranes, particles with a mass or a
/// torque, ellipses, or particles that cross a membrane.
void check_others(const case_file::TomlSection& first, const ParticlesCase& c);

}  // namespace viscontact::particles
