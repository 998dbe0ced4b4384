// What of a run cannot end well, seen before the long tabulation.
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"

namespace viscontact {

/// Throws Error(kBadInput) naming the case if its gaps are fewer than the terms to be fitted, or a model that needs the drag would start outside them without
/// an extension (`[fit] below`, `above`).
void check_run(const Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the case's tabulated gaps, and how far they will
/// go. The motion is computed with the exact drag of a plane in a half-space, so nothing is said for
/// another geometry, nor where a model takes more than a million steps.
void warn_of_gaps_outside(const Case& c, const std::vector<std::string>& models);

}  // namespace viscontact
