// The inputs from which a trajectory was made. `run` decides by this record whether a trajectory is
// up to date, so a change must keep that the record names everything that alters a trajectory.
// Numbers are in the units of the case; a damaged file counts as out of date.
#pragma once

#include <string>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// The lines "# key: value" that identify the inputs of a trajectory: hashes of case, fit (the text
/// `fit_text`) and forces, limits of the drag, revision of the models and version.
CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const lubrication::OutsideInterval& outside);

/// True if the folder has a trajectory of the model that was made from the inputs `identity`.
bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity);

}  // namespace viscontact::pipeline
