// The command `swimmer`: the table of resistance matrices of spheres on a line, its fit, strokes of
// a swimmer made of these spheres, and the report. Results are in the units of the case. app/ and
// python/ call it. Wrong inputs throw Error(kBadInput) before anything is written, a stop
// Error(kInterrupted). A change must keep names of files, keys and columns, which users' scripts
// read.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"

namespace viscontact::swimmer {

/// The table of resistance matrices of a case, in the file `table`, and how it is computed. Throws
/// Error(kBadInput) if the case names the file of a table, so that there is none to compute.
pipeline::CaseTable case_table(const SwimmerCase& c, const std::filesystem::path& table);

/// The options of the command `swimmer`.
struct SwimmerRequest {
  std::string case_file, folder;  ///< path of the case, and of the folder for the results
  int jobs = 1;                   ///< FreeFEM processes at once, >= 1
  bool json = false;              ///< true: print swimmer.json to standard output
  StopToken stop{};               ///< a stop throws Error(kInterrupted); finished files are kept
};

/// Writes table.csv, fit.json, stroke.csv, optimal_stroke.csv, swimmer.json and the report into the
/// folder (docs/file-formats.md). A table or fit that was made from the same inputs is kept, and
/// rows that an interrupted call has finished are not computed again. Throws Error(kBadInput)
/// before anything is written if the case is wrong or a file of the user would be replaced, and the
/// errors of pipeline::tabulate_stage(), fit_resistance(), swim_sums() and find_optimal_stroke().
void run_swimmer(const SwimmerRequest& request);

/// Writes the report again from the files that run_swimmer() wrote into `folder`, and from the
/// case, which must not have changed since. Throws Error(kBadInput) if one of them is missing,
/// changed or damaged, and Error(kInterrupted) if `stop` requests a stop.
void report_swimmer(const std::filesystem::path& folder, const StopToken& stop);

}  // namespace viscontact::swimmer
