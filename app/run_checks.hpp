// What of a run cannot end well, seen before the long tabulation.
#pragma once

#include <string>
#include <vector>

#include "case_file/case_file.hpp"

namespace viscontact {

/// Throws Error(kBadInput) naming the case if its gaps are fewer than the terms to be fitted, or a model that needs the drag would start outside them without
/// an extension (`[fit] below`, `above`).
void check_run(const Case& c, const std::vector<std::string>& models);

}  // namespace viscontact
