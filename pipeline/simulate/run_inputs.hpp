// Keeps the inputs of a run with its results. The inputs (case, files of sampled external forces,
// fit of the drag) are copied into the run's folder, so that the folder alone repeats the run.
// Comments of a trajectory say from which inputs it was made, so that `run` can decide whether it
// is up to date. The only numbers here are hashes (SHA-256, in hexadecimal digits). The other files
// of pipeline/ call these functions, which throw Error(kBadInput) if a file cannot be read or
// written (except is_simulated()). A change must keep that a copy never replaces a file of the
// user, and that the comments identify everything that alters a trajectory.
#pragma once

#include <string>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// True if Viscontact has simulated into this folder before: the sub-folder trajectories/ exists
/// and contains a file that Viscontact wrote, or is empty because the run was interrupted. Throws
/// std::filesystem::filesystem_error if the sub-folder cannot be listed.
bool holds_a_run(const results::RunFolder& run);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace a different
/// file of the same name in a folder without a run, because that file is the user's. In a folder
/// with a run (holds_a_run()), that file is the copy that the earlier run made, and it may be
/// replaced.
void check_case_copies(const results::RunFolder& run, const case_file::Case& c);

/// Throws Error(kBadInput) if a copy of the fit, whose text is `fit_text`, would replace a
/// different file fit.json in a folder without a run, because that file is the user's.
void check_fit_copy(const results::RunFolder& run, const std::string& fit_text);

/// Makes the folder of trajectories, then writes the copies of the case, its force files and the
/// fit. A change must keep this order: the run can be interrupted in this function, and
/// holds_a_run() must then be true, so that the next run may replace the copies.
void write_copies(const results::RunFolder& run, const case_file::Case& c,
                  const std::string& fit_text);

/// The comment lines "# key: value" that identify the inputs of a trajectory: hashes of the case,
/// of the fit (the text `fit_text`) and of the force files, the choice of the drag outside the
/// fit's interval, the revision of the models and the version of Viscontact. Without force files
/// there is no key `force`. If no formula for the drag below (or above) the interval was chosen,
/// there is no key for that side.
CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside);

/// True if the folder has a trajectory of the model with all comments of `identity`, and with no
/// comment on the drag outside the fit's interval that `identity` lacks; other comments may differ.
/// False if there is no trajectory or if it cannot be read. No Error is thrown.
bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity);

}  // namespace viscontact::pipeline
