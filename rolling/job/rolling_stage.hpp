// The command `rolling`: tables of the drag, their fit, trajectories and report of a sphere that
// moves along a plane and turns. Results are in the units of the case. app/ calls it. Wrong inputs
// throw Error(kBadInput) before anything is written; a model that fails throws after the results of
// the others are written. A change must keep the names of the files, keys and columns, which users'
// scripts read.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::rolling {

/// The options of the command `rolling`.
struct RollingRequest {
  std::string case_file, folder;  ///< path of the case, and of the folder for the results
  int jobs = 1;                   ///< FreeFEM processes at once, >= 1
  bool json = false;              ///< true: print rolling.json to standard output
  StopToken stop{};               ///< a stop throws Error(kInterrupted); finished files are kept
};

/// Writes the tables (tables/MOTION.csv) and their fit (fit.json) unless the case names a fit, then
/// MODEL.csv for each model, rolling.json and the report into the folder (docs/file-formats.md).
/// Files that were made from the same inputs and would be the same are left alone. Throws
/// Error(kBadInput) before anything is written if the case is wrong or a file of the user would be
/// replaced, and the errors of pipeline::tabulate_stage() and motions::fit_pair_stage(). If a model
/// fails, the results of the others are written before an Error that names the model is thrown; if
/// all models fail, only tables and fit are written.
void run_rolling(const RollingRequest& request);

/// Writes the report again from the files that run_rolling() wrote into `folder`, and from the case
/// and the fit that they name, which must not have changed since. Throws Error(kBadInput) if one of
/// these files is missing, changed or damaged, and Error(kInterrupted) if `stop` requests a stop.
void report_rolling(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::rolling
