// Checks a case for errors before the tabulation of the drag starts, which can take hours. The
// stages of pipeline/ that run models call the checks. Gaps [L], > 0, are in the unit of the case.
// `models` are the names of models, in any order. All functions throw Error(kBadInput) if the case
// lacks the section [motion]; check_run() and warn_of_gaps_outside() also need [tabulation], with
// at least one gap, and [fit]. A change must keep the checks quick, about a second.
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Throws Error(kBadInput), which names the case, if a name in `models` is not that of a model, or
/// if a model refuses the motion or one of its parameters, such as a time step. The check uses the
/// exact drag near a plane, because this drag is known at every gap.
void check_parameters(const case_file::Case& c, const std::vector<std::string>& models);

/// Throws Error(kBadInput), which names the case, in three cases: tabulation.gaps has fewer
/// different gaps than coefficients are fitted; check_parameters() throws; or a model needs the
/// tabulated drag at the initial gap, this gap is outside tabulation.gaps, and [fit] gives no
/// formula for the drag there (keys `below`, `above`). If the initial gap is below tabulation.gaps,
/// contact models do not need the drag there; if it is above, the contact models that resolve the
/// drag between contacts do.
void check_run(const case_file::Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the interval of tabulation.gaps and will therefore
/// fail, and says which gap they reach. Nothing is said on a side for which [fit] gives a formula
/// (keys `below`, `above`). The motion is estimated with the exact drag near a plane in a
/// half-space. Therefore nothing is checked for other geometries, nor for motions of more than a
/// million steps, which would take too long; this limit is a free choice. A model whose motion
/// cannot be estimated is skipped. Throws Error(kBadInput) for an unknown model, and
/// Error(kInterrupted) if `stop` requests a stop.
void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop);

}  // namespace viscontact::pipeline
