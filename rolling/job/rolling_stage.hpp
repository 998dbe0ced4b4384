// The command `rolling`: it makes the tables of the drag on a sphere that moves along a plane and
// turns, their fit, the trajectories and the report. Lengths [L], masses [M] and times [T] are in
// the units of the case. app/ calls this file. Wrong inputs throw Error(kBadInput) before anything
// is written; if a model fails, its error is thrown after the results of the other models are
// written. A change must keep the names of the files, keys and columns, which users' scripts read.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::rolling {

/// The options of the command `rolling`.
struct RollingRequest {
  std::string case_file, folder;  ///< path of the case, and of the folder for the results
  int jobs = 1;                   ///< FreeFEM processes at once, >= 1 (not checked)
  bool json = false;              ///< true: print rolling.json to standard output
  StopToken stop{};               ///< a stop throws Error(kInterrupted); finished files are kept
};

/// Writes the tables (tables/MOTION.csv) and their fit (fit.json) unless the case names a fit, then
/// MODEL.csv for each model, rolling.json and the report into the folder (docs/file-formats.md).
/// Files that were made from the same inputs and would be the same are left as they are. Throws
/// Error(kBadInput) before anything is written if the case is wrong or a file of the user would be
/// replaced; Error(kBadInput) if the folder is locked, the tables cannot be fitted or a file cannot
/// be written; Error(kExternalProgram) if FreeFEM cannot be run, rows of a table fail, or gnuplot
/// fails; and Error(kInterrupted) after a stop. If a model fails, the results of the other models
/// are written before an Error that names the model is thrown; if all models fail, only tables and
/// fit are written.
void run_rolling(const RollingRequest& request);

/// Writes the report again from the files that run_rolling() wrote into `folder`, and from the case
/// and the fit that these files name, which must not have changed since. Throws Error(kBadInput) if
/// one of the files is missing, changed or damaged, Error(kExternalProgram) if gnuplot fails, and
/// Error(kInterrupted) if `stop` requests a stop.
void report_rolling(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::rolling
