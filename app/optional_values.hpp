// Options whose value may be left out: keeps them from taking the file after them as their value.
#pragma once

#include <string>
#include <vector>

namespace viscontact::app {

/// Returns the arguments of a command line, from the command's name on, in an order that CLI11
/// reads correctly. An option whose value may be left out (`fit --fix`, `tabulate --plot`,
/// `simulate --lubrication-limit`) would take the word after it as its value even if that is the
/// command's file, as in `fit --fix own.csv`. In this case the option is moved to the end, or
/// before the word "--".
std::vector<std::string> with_files_apart(std::vector<std::string> arguments);

}  // namespace viscontact::app
