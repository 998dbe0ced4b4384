// The results of a run of one sphere, read from its folder, in the units of the case.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact::results {

struct RunResults {
  RunFolder folder;
  case_file::Case c;
  lubrication::Fit fit;                  ///< scaled to radius [L] and viscosity of the case
  bool fit_is_scaled = false;            ///< fit.json is that of another radius or viscosity
  reduced_model::Comparison comparison;  ///< that in comparison.json
  /// The trajectories of the models of the comparison whose files exist; at least one.
  std::vector<reduced_model::Trajectory> trajectories;
  /// The table from which the fit was made; nothing if the case needs no table, if the folder has
  /// none, or if fit_is_scaled is true. A case that asks for an exact or a given fit needs no
  /// table, unless its fit was made from the table of the folder.
  std::optional<lubrication::MotionTable> table;
  /// How the errors of the fit change the gaps; nothing if the folder has no uncertainty.json.
  std::optional<reduced_model::FitUncertainty> uncertainty;
};

/// Throws Error(kBadInput) if case, fit, comparison or all trajectories are missing, if one of
/// these files, the table or the uncertainty is wrong or cannot be read, or if the fit is for
/// another geometry than the case; and std::filesystem::filesystem_error if the system refuses a
/// path. The files need not belong together, and the case need not have a motion.
RunResults read_run(const std::filesystem::path& folder);

/// The paths of the files that the results were read from, at least four.
std::vector<std::filesystem::path> files_of(const RunResults& results);

}  // namespace viscontact::results
