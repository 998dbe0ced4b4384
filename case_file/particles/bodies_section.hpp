// The tables [[body]] of a case: rigid bodies of several particles. Units are those of the case.
#pragma once

#include <string>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// Reads [[body]] into c.particles.bodies. The particles, and their motion, must have been read.
/// Throws Error(kBadInput) with file, line and key for a wrong value; for a particle that does not
/// exist, is named twice or belongs to an earlier body; and for a motion that is given in a fluid.
void read_bodies(const TomlSection& root, ParticlesCase& c);

/// ", of body 2" if a particle belongs to a body, else nothing: for messages about overlaps.
std::string body_in_words(const ParticlesCase& c, std::int32_t particle);

}  // namespace viscontact::case_file
