// Writes and reads the state of a simulation, bit for bit, so that a run can be continued. Numbers
// are stored without conversion, in the units of the case (lengths [L], times [T], masses [M]);
// write_restart() throws nothing. run/ uses this file. A change must keep files of versions 6 to 12
// readable, and a continued run equal to an uninterrupted one, bit for bit. A new member of State
// that a continued run needs therefore gets a new version of the file (restart.cpp).
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Content of a restart file: a line of text that names the format and the byte order, a line with
/// the SHA-256 of the rest, and the rest in binary, in the byte order of this machine. The ids of
/// the particles, and which particles form rigid bodies, are not stored, because the case has them.
std::string write_restart(const State& state);

/// Reads a restart file of version 6 to 12. It may begin with lines that state its provenance,
/// which run/ writes. For rigid bodies only the motion is set. Throws Error(kBadInput), which names
/// the file, if the file cannot be read, is not a restart file, has another version, is damaged
/// (its hash, or lengths, signs or ranges of its arrays are wrong), or was written with another
/// byte order. Whether it fits a case is not checked here but in run/particles_earlier_run.hpp.
State read_restart(const std::filesystem::path& path);

}  // namespace viscontact::particles
