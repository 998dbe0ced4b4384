// The state of a simulation in a file, bit for bit.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Two lines of text, what it is and the SHA-256 of the rest; then the rest, binary, in the order of bytes of the machine.
std::string write_restart(const State& state);

/// Reads it back. Throws Error(kBadInput) naming the file if it is no such file, damaged, or of a machine with another order of bytes.
State read_restart(const std::filesystem::path& path);

}  // namespace viscontact::particles
