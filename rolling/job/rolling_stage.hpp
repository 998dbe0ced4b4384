// The command `rolling`: tables of the drag, their fit, trajectories and report.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::rolling {

struct RollingRequest {
  std::string case_file, folder;  ///< path of the case, and of the folder for the results
  int jobs = 1;                   ///< FreeFEM processes at once, >= 1
  bool json = false;              ///< true: print rolling.json to standard output
  StopToken stop{};               ///< a stop throws Error(kInterrupted); finished files are kept
};

/// Writes the tables (tables/MOTION.csv) and their fit (fit.json) unless the case names a fit, then
/// MODEL.csv for each model, rolling.json and the report into the folder (docs/file-formats.md).
/// Files that would be the same are left as they are. Throws Error(kBadInput) before anything is
/// written if the case is wrong or a file of the user would be replaced; Error(kBadInput) if the
/// folder is locked, the tables cannot be fitted or a file cannot be written;
/// Error(kExternalProgram) if FreeFEM cannot be run, rows of a table fail, or gnuplot fails; and
/// Error(kInterrupted) after a stop. If a model fails, the results of the other models are written
/// before an Error that names the model is thrown; if all models fail, only tables and fit are
/// written.
void run_rolling(const RollingRequest& request);

/// Writes the report again from the files that run_rolling() wrote into `folder`, and from the case
/// and the fit that these files name, which must not have changed since. Throws Error(kBadInput) if
/// one of the files is missing, changed or damaged, Error(kExternalProgram) if gnuplot fails, and
/// Error(kInterrupted) if `stop` requests a stop.
void report_rolling(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::rolling
