// Checks of a case, in about a second, before the tabulation of the drag starts, which can take
// hours. All throw Error(kBadInput) if the case lacks the section [motion].
#pragma once

#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Throws Error(kBadInput), which names the case, if a name in `models` is not that of a model, or
/// if a model refuses the motion or one of its parameters with the exact drag near a plane, which
/// is known at every gap.
void check_parameters(const case_file::Case& c, const std::vector<std::string>& models);

/// Throws Error(kBadInput), which names the case, in four cases: [tabulation] or [fit] is missing;
/// tabulation.gaps has fewer different gaps than coefficients are fitted; check_parameters()
/// throws; or a model needs the tabulated drag at the initial gap, this gap is outside
/// tabulation.gaps, and [fit] gives no formula for the drag there (keys `below`, `above`). Below
/// tabulation.gaps contact models do not need the drag; above, those that resolve the drag between
/// contacts do.
void check_run(const case_file::Case& c, const std::vector<std::string>& models);

/// Warns on standard error if models will leave the interval of tabulation.gaps and will therefore
/// fail, and says which gap they reach. Nothing is said on a side for which [fit] gives a formula
/// (keys `below`, `above`). The motion is estimated with the exact drag near a plane in a
/// half-space. Therefore nothing is said for other geometries, nor for motions of more than a
/// million steps, which would take too long. A model whose motion cannot be estimated is skipped.
/// Throws Error(kBadInput) for an unknown model or a missing [tabulation] or [fit], and
/// Error(kInterrupted) at a stop.
void warn_of_gaps_outside(const case_file::Case& c, const std::vector<std::string>& models,
                          const StopToken& stop);

}  // namespace viscontact::pipeline
