// What a trajectory was made from. `run` decides by this record whether a trajectory is up to date,
// so the record must name everything that changes a trajectory.
#pragma once

#include <string>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::pipeline {

/// What the drag is outside the interval of the fit: an error, or a limit.
struct OutsideFit {
  lubrication::BelowInterval below = lubrication::BelowInterval::kError;
  lubrication::AboveInterval above = lubrication::AboveInterval::kError;
};

/// The lines "# key: value" that identify the inputs of a trajectory: hashes of case, fit (the text
/// `fit_text`) and forces, limits of the drag, revision of the models and version.
CsvComments identity_of_trajectory(const case_file::Case& c, const std::string& fit_text,
                                   const OutsideFit& outside);

/// True if the folder has the model's trajectory and this was made from the inputs `identity`.
bool is_simulated(const results::RunFolder& run, const std::string& model,
                  const CsvComments& identity);

}  // namespace viscontact::pipeline
