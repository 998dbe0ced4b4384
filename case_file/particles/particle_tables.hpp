// The particles of a case (docs/case-file.md, "Many particles"): the sections [particles],
// [[particle]], [arrangement] and [[force]]. Lengths, masses and times are in the units of the
// case.
#pragma once

#include <vector>

#include "viscontact/case_file/particles/particles_case.hpp"
#include "viscontact/case_file/particles/particles_start.hpp"
#include "viscontact/case_file/toml_section.hpp"

namespace viscontact::case_file {

/// Reads the particles, first those of the CSV file, then those of the tables [[particle]] and
/// those of [arrangement], with their forces, torques and given motions. Needs c.path, c.end_time,
/// c.particles.dimension, c.setting.domain and c.setting.fluid. Returns where the particles are
/// given.
///
/// Throws Error(kBadInput) with file, line and key for a wrong value; if there is no particle; for
/// a key of particles in a fluid if the case has no fluid; for a rotation on an axis; and for a
/// force, a torque or an initial velocity of a particle whose motion is given, because it has no
/// effect.
ParticleLines read_particles_of_case(const TomlSection& root, ParticlesCase& c);

/// Reads [[force]]: the same force on all particles whose ids it names. The particles must have
/// been read. Throws Error(kBadInput) as above, and for an id that does not exist or has a force
/// already.
void read_forces_by_id(const TomlSection& root, ParticlesCase& c);

}  // namespace viscontact::case_file
