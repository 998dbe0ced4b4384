// The command `tabulate`.
#pragma once

#include <CLI/CLI.hpp>

namespace viscontact {

void add_tabulate(CLI::App& app);

}  // namespace viscontact
