// Reads the results of a run from its folder, for the report. Lengths, masses and times are in the
// units of the case. A file that is missing or wrong throws Error(kBadInput). A change must keep
// the folders of earlier versions readable. Used by report/.
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

/// The results of a run.
struct RunResults {
  RunFolder folder;                      ///< the folder of the run
  case_file::Case c;                     ///< the case that was run
  lubrication::Fit fit;                  ///< scaled to radius [L] and viscosity of the case
  bool fit_is_scaled = false;            ///< true: fit.json is that of another radius or viscosity
  reduced_model::Comparison comparison;  ///< of the trajectories
  /// The trajectories of those models of the comparison whose files exist; at least one.
  std::vector<reduced_model::Trajectory> trajectories;
  /// The table that the fit was made from; nothing if the run needs or has none, or if
  /// fit_is_scaled.
  std::optional<lubrication::MotionTable> table;
  std::optional<reduced_model::FitUncertainty> uncertainty;  ///< errors by the fit; nothing: none
};

/// Reads the results of the run in `folder`. Throws Error(kBadInput) if case, fit, comparison or
/// all trajectories are missing, if a file that is there is wrong or cannot be read, or if the fit
/// is for another geometry than the case (case_file::fit_for()). That files belong together, or
/// that the case has a motion, is not checked.
RunResults read_run(const std::filesystem::path& folder);

/// The paths of the files that the results were read from, at least four.
std::vector<std::filesystem::path> files_of(const RunResults& results);

}  // namespace viscontact::results
