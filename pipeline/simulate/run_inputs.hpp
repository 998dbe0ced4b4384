// The inputs of a run that are kept with its results, so that the folder alone repeats the run.
#pragma once

#include <string>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// True if Viscontact has simulated into this folder before: the sub-folder trajectories/ contains
/// a file that Viscontact wrote, or is empty because the run was interrupted. Throws
/// std::filesystem::filesystem_error if the sub-folder cannot be listed.
bool holds_a_run(const results::RunFolder& run);

/// Throws Error(kBadInput) if a copy of the case or of its force files would replace a different
/// file of the same name in a folder without a run, because that file is the user's, or if a file
/// cannot be read.
void check_case_copies(const results::RunFolder& run, const case_file::Case& c);

/// Does what check_case_copies() does for the copy of the fit, fit.json.
void check_fit_copy(const results::RunFolder& run, const std::string& fit_text);

/// Makes the folder of trajectories, then writes the copies of the case, its force files and the
/// fit. Throws Error(kBadInput) if a file cannot be read or written.
void write_copies(const results::RunFolder& run, const case_file::Case& c,
                  const std::string& fit_text);

/// The comment lines that identify everything that alters a trajectory: hashes (SHA-256) of the
/// case, of the fit and of the force files, the choice of the drag outside the fit's interval, the
/// revision of the models and the version of Viscontact. Throws Error(kBadInput) if a force file
/// cannot be read.
CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside);

/// True if the folder has a trajectory of the model with all comments of `identity`, and with no
/// comment on the drag outside the fit's interval that `identity` lacks; other comments may differ.
/// False if there is no trajectory or if it cannot be read.
bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity);

}  // namespace viscontact::pipeline
