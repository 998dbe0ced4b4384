// Checks a case for errors before the tabulation starts, which can take hours. The main job calls
// the checks. Gaps [L] are in the unit of the case. The checks must stay quick, about a second.
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Throws Error(kBadInput), which names the case, if a parameter of a model is wrong. The check
/// uses the exact drag near a plane, because it is known at every gap.
void check_parameters(const case_file::Case& c, const std::vector<std::string>& models);

/// Throws Error(kBadInput) that names the case if it has fewer gaps than terms to be fitted, if a
/// parameter of a model is wrong, or if a model that needs the drag would start outside the gaps
/// while the case asks for no limit there (`[fit] below`, `above`).
void check_run(const case_file::Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the interval of the case's gaps, and says how far.
/// The motion is estimated with the exact drag near a plane in a half-space; therefore other
/// geometries are not checked. Motions of more than a million steps are not checked either.
void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop);

}  // namespace viscontact::pipeline
