// The state of a simulation as a file, bit for bit and in the units of the case.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// Content of a restart file: a line of text that names the format and the byte order, a line with
/// the SHA-256 of the rest, and the rest in binary, in the byte order of this machine. The ids of
/// the particles, and which particles form rigid bodies, are not stored, because the case has them.
std::string write_restart(const State& state);

/// Reads a restart file of the present version. It may begin with lines that state its provenance.
/// Of rigid bodies only the motion is set. Throws Error(kBadInput), which names the file, if the
/// file cannot be read, is not a restart file, has another version or byte order, or is damaged
/// (its hash, or lengths, signs or ranges of its arrays are wrong). particles_earlier_run.hpp
/// checks whether it fits a case.
State read_restart(const std::filesystem::path& path);

}  // namespace viscontact::particles
