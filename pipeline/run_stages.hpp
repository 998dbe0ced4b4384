// The five stages of `viscontact run`: tabulate the drag, fit it, compute the motion by each model,
// compare the motions, write the report.
#pragma once

#include <filesystem>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Runs the stages on the case `c`, and writes their files into `folder`, which is made if it is
/// missing (results/run_folder.hpp has the names). `jobs` >= 1 rows of the table are computed at
/// once. A stage whose inputs have not changed is not run again. The comparison is printed, as JSON
/// if `json` is true, else as a table. Throws Error(kBadInput) before the tabulation starts if the
/// case is wrong, if it lacks [motion] or [fit] (or [tabulation], unless [fit] names a fit or the
/// exact drag), or if a file of the user would be replaced. If some rows of the table or some
/// models fail, the error that names them is thrown after all results of the others are written; if
/// all fail, at once. Throws the other errors of the stages, such as Error(kExternalProgram) if
/// FreeFEM or gnuplot fails, and Error(kInterrupted) at a stop; finished results are kept.
void run_stages(const case_file::Case& c, const std::filesystem::path& folder, int jobs, bool json,
                const StopToken& stop);

}  // namespace viscontact::pipeline
