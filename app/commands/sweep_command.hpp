// viscontact sweep.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

/// Adds the command.
void add_sweep(CLI::App& app);

}  // namespace viscontact
