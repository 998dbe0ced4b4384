// Checks a case for errors before the tabulation of the drag starts, which can take hours. The
// stages of pipeline/ that run models call the checks. Gaps [L] are in the unit of the case. A
// change must keep the checks quick, about a second. All of them throw Error(kBadInput) if the case
// lacks a section that they need.
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Throws Error(kBadInput), which names the case, if a model of this name does not exist or a
/// parameter of a model is wrong. The check uses the exact drag near a plane, because it is known
/// at every gap.
void check_parameters(const case_file::Case& c, const std::vector<std::string>& models);

/// Throws Error(kBadInput), which names the case, if it has fewer different gaps than coefficients
/// to be fitted, if a model would start above the case's gaps, or a model that is no contact model
/// below them, and needs the drag there while the case asks for no formula (keys `below`, `above` of
/// [fit]), or if check_parameters() throws.
void check_run(const case_file::Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the interval of the case's gaps, and says how far.
/// The motion is estimated with the exact drag near a plane in a half-space. Therefore nothing is
/// checked for other geometries, nor for motions of more than a million steps, which would take too
/// long. Throws Error(kInterrupted) if `stop` requests a stop.
void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop);

}  // namespace viscontact::pipeline
