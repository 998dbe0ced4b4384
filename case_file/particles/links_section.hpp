// The tables [[hinge]], [[spring]] and [[arm]] of a case. Units are those of the case.
#pragma once

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// Reads the links into c.setting.links. Particles and bodies must have been read.
///
/// Throws Error(kBadInput) with file, line and key for a wrong value; for particles and bodies that
/// do not exist; for a hinge outside its body; for a spring or an arm between particles of one body;
/// and for an arm whose length at the start is not the distance of its particles, is less than the
/// sum of their radii at a later time, or breaks the triangle inequality with two other arms.
void read_links(const TomlSection& root, ParticlesCase& c);

}  // namespace viscontact::case_file
