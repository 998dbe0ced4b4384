// The command `particles`: simulates many particles (pipeline/particles/particles_stage.hpp).
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

/// Adds the command `particles`.
void add_particles(CLI::App& app);

}  // namespace viscontact
