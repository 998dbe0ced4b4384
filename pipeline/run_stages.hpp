// Runs the five stages of `viscontact run` in order: the drag of the sphere is tabulated over the
// gap, a formula is fitted to the table, each model computes the motion, the motions are compared,
// and the report is written. The command `run` calls run_stages(). Numbers are in the units of the
// case. Error(kBadInput) is thrown before the first stage if the case is wrong. If a row or a model
// fails, its error is thrown after the others are done. A change must keep the order, because each
// stage reads the files of those before it.
#pragma once

#include <filesystem>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Runs the stages on the case `c`, and writes table.csv, fit.json, trajectories, comparison and
/// report into `folder`, which is made if it is missing (results/run_folder.hpp has the names).
/// `jobs` >= 1 (not checked) rows of the table are computed at once. A stage whose inputs have not
/// changed is not run again. The comparison is printed, as JSON if `json` is true, else as a table.
/// Throws Error(kBadInput) before the tabulation starts if the case is wrong, if it lacks [motion]
/// or [fit] (or [tabulation], unless [fit] names a fit or the exact drag), or if a file of the user
/// would be replaced. If some rows of the table or some models fail, the error that names them is
/// thrown after all results of the others are written. If all rows or all models fail, the error is
/// thrown at once. Throws the other errors of the stages (tabulate_stage.hpp, fit_stages.hpp,
/// simulate_stage.hpp, compare_stage.hpp, report.hpp), such as Error(kExternalProgram) if FreeFEM
/// or gnuplot fails, and Error(kInterrupted) if `stop` requests a stop; finished results are kept.
void run_stages(const case_file::Case& c, const std::filesystem::path& folder, int jobs, bool json,
                const StopToken& stop);

}  // namespace viscontact::pipeline
