// viscontact particles: the command line of many particles.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

/// Adds the command `particles`.
void add_particles(CLI::App& app);

}  // namespace viscontact
