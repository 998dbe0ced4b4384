// Writes and reads the state of a simulation, bit for bit, so that a run can be continued. Numbers
// are stored without conversion, in the units of the case. The stage of particles uses it. A change
// must keep files of all earlier versions readable.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Content of a restart file: a line of text that names the format and the byte order, a line with
/// the SHA-256 of the rest, and the rest in binary, in the byte order of this machine. The ids of
/// the particles, and which particles form rigid bodies, come from the case.
std::string write_restart(const State& state);

/// Reads a restart file of version 1 to 11. Of rigid bodies only the motion is set. Throws
/// Error(kBadInput), which names the file, if it is not a restart file, is damaged, or was written
/// with another byte order.
State read_restart(const std::filesystem::path& path);

}  // namespace viscontact::particles
