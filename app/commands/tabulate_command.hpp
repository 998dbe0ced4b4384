// The command `tabulate`.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

/// Adds the command `tabulate`.
void add_tabulate(CLI::App& app);

}  // namespace viscontact
