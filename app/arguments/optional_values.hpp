// Reorders a command line, so that an option whose value may be left out does not take the file
// after it as its value.
#pragma once

#include <string>
#include <vector>

namespace viscontact::app {

/// Returns the arguments of a command line, from the command's name on, in an order that CLI11
/// reads correctly. An option whose value may be left out (`fit --fix`, `tabulate --plot`,
/// `simulate --lubrication-limit`) would take the word after it as its value even if that is the
/// command's file, as in `fit --fix own.csv`. In this case the option is moved to the end of the
/// arguments or, if they contain the word "--", to just before it. A further option whose value may
/// be left out must be added to the list in optional_values.cpp.
std::vector<std::string> with_files_apart(std::vector<std::string> arguments);

}  // namespace viscontact::app
