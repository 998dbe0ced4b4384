// The inputs of a run: their copies in its folder (case, force files, fit), so that the folder
// alone repeats the run, and the record of what a trajectory was made from, by which `run` decides
// whether it is up to date. The stages of the main job call it. Numbers are in the units of the
// case. A copy must never replace a file of the user, and the record must name everything that
// alters a trajectory.
#pragma once

#include <string>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// True if Viscontact has simulated into this folder before. The sign of it is a sub-folder
/// trajectories/ that contains a file that Viscontact wrote, or that is empty because the run was
/// interrupted.
bool holds_a_run(const results::RunFolder& run);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace a different
/// file of the same name in a folder without a run, because that file is the user's. In a folder
/// with a run, that file is the copy that the earlier run made, and it may be replaced.
void check_case_copies(const results::RunFolder& run, const case_file::Case& c);

/// Throws Error(kBadInput) if a copy of the fit with this text would replace a file of the user, as
/// check_case_copies() does for the case.
void check_fit_copy(const results::RunFolder& run, const std::string& fit_text);

/// Makes the folder of trajectories, then writes the copies. This order is needed, because
/// holds_a_run decides by the folder of trajectories whether the copies may be replaced, and the
/// run can be interrupted in this function.
void write_copies(const results::RunFolder& run, const case_file::Case& c,
                  const std::string& fit_text);

/// The lines "# key: value" that identify the inputs of a trajectory: hashes of case, fit (the text
/// `fit_text`) and forces, limits of the drag, revision of the models and version.
CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside);

/// True if the folder has a trajectory of the model that was made from the inputs `identity`.
bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity);

}  // namespace viscontact::pipeline
