// Options that may stand without a value, told from the file that stands behind them.
#pragma once

#include <string>
#include <vector>

namespace viscontact {

/// The arguments of a command line, from the command's name on. An option that may stand without
/// a value (`fit --fix`, `tabulate --plot`, `simulate --lubrication-limit`) would take the word
/// behind it as its value even where that is the command's file, as in `fit --fix own.csv`. There
/// the option is moved behind all others.
std::vector<std::string> with_files_apart(std::vector<std::string> arguments);

}  // namespace viscontact
