// The command `sweep`: runs a case with many values of some keys.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

/// Adds the command `sweep`.
void add_sweep(CLI::App& app);

}  // namespace viscontact
