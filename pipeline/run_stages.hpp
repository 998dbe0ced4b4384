// Runs the five stages of the main job in order: the drag of the sphere is tabulated over the gap,
// a formula is fitted to the table, each model simulates the motion, the motions are compared, and
// the report is written. The command `run` calls it; a change must keep the order, because each
// stage reads the files of those before it.
#pragma once

#include <filesystem>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// Tabulates (`jobs` >= 1 rows at once), fits, simulates, compares and reports into a run's folder.
/// A stage whose inputs have not changed is not run again. Errors of the case, and files that must
/// not be replaced, are found before the tabulation starts. If rows of the table or models failed,
/// the error of the first is thrown after the results of the others are written. If `json` is true,
/// the comparison is printed as JSON. If `stop` requests a stop, throws Error(kInterrupted);
/// results that are finished are kept.
void run_stages(const case_file::Case& c, const std::filesystem::path& folder, int jobs, bool json,
                const StopToken& stop);

}  // namespace viscontact::pipeline
