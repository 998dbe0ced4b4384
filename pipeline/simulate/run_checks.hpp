// Checks a case for errors before the tabulation of the drag starts, which can take hours. The
// stages of pipeline/ that run models call the checks. Gaps [L] are in the unit of the case;
// `models` are names of models, in any order. A change must keep the checks quick, about a second.
// All of them throw Error(kBadInput) if the case lacks a section that they need: [motion], and but
// for check_parameters() also [tabulation] and [fit].
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Throws Error(kBadInput), which names the case, if a model of this name does not exist, or if a
/// parameter of a model, or the motion, is one that the model refuses. The check uses the exact
/// drag near a plane, because it is known at every gap.
void check_parameters(const case_file::Case& c, const std::vector<std::string>& models);

/// Throws Error(kBadInput), which names the case, in three cases: tabulation.gaps has fewer
/// different gaps than coefficients are fitted; check_parameters() throws; or a model needs the
/// tabulated drag at the initial gap, this gap is outside tabulation.gaps, and [fit] gives no
/// formula for it (keys `below`, `above`). Below the gaps, no contact model needs the drag at the
/// initial gap; above them, those that resolve drag do.
void check_run(const case_file::Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the interval of the case's gaps, and says how far.
/// The motion is estimated with the exact drag near a plane in a half-space. Therefore nothing is
/// checked for other geometries, nor for motions of more than a million steps, which would take too
/// long. A model whose motion cannot be estimated is skipped. Throws Error(kBadInput) for an
/// unknown model, and Error(kInterrupted) if `stop` requests a stop.
void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop);

}  // namespace viscontact::pipeline
