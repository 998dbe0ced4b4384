// The command `swimmer`: table and fit of resistance matrices, strokes, and report.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"

namespace viscontact::swimmer {

/// The plan of the table of resistance matrices of a case, to be written to the path `table`.
/// Throws Error(kBadInput) if the case names the file of a table, so that there is none to compute.
pipeline::CaseTable case_table(const SwimmerCase& c, const std::filesystem::path& table);

struct SwimmerRequest {
  std::string case_file, folder;  ///< path of the case, and of the folder for the results
  int jobs = 1;                   ///< FreeFEM processes at once, >= 1
  bool json = false;              ///< true: print swimmer.json to standard output
  StopToken stop{};               ///< a stop throws Error(kInterrupted); finished files are kept
};

/// Writes table.csv, fit.json, stroke.csv, optimal_stroke.csv, swimmer.json and the report into the
/// folder (docs/file-formats.md). A table or fit that was made from the same inputs is kept, and
/// rows that an interrupted call has finished are not computed again. Throws Error(kBadInput)
/// before anything is written if the case is wrong or a file of the user would be replaced, later
/// if the table cannot be fitted, a stroke leaves the table or a file cannot be written. Throws
/// Error(kExternalProgram) if FreeFEM cannot be run, a row of the table fails or gnuplot fails;
/// Error(kNotConverged) if the integrals over the time of a stroke or the search for the stroke of
/// least energy do not converge; and Error(kInterrupted) after a stop.
void run_swimmer(const SwimmerRequest& request);

/// Writes the report again from the files that run_swimmer() wrote into `folder`, and from the
/// case, which must not have changed since. Throws Error(kBadInput) if one of these files is
/// missing, changed or damaged, Error(kExternalProgram) if gnuplot fails, and Error(kInterrupted)
/// if `stop` requests a stop.
void report_swimmer(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::swimmer
