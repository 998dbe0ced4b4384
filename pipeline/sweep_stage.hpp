// Runs a sweep of any kind of case: computes the rows of a study (sweep/study.hpp: a case is
// computed again and again with other values of some keys, and the results of each computation are
// a row) and writes them into a CSV file. Numbers are in the units of the case. The command `sweep`
// and particles/sweep call these functions. If a row fails, nothing is thrown, and its column
// `failure` says why. Error(kNotConverged) is thrown if nothing could be computed in any row,
// Error(kInterrupted) at a stop. A change must keep that finished rows are never computed again.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::pipeline {

/// The options of a sweep.
struct SweepStageRequest {
  std::string output;  ///< path of the file of rows (CSV)
  int jobs = 1;        ///< number of rows that are computed at once, >= 1 (not checked)
  StopToken stop{};    ///< a requested stop ends the sweep with Error(kInterrupted)
};

/// Computes the missing rows and writes the file of rows, shows the progress on the terminal, and
/// says there how many rows there are and how many failed. `inputs` are the files that the rows
/// depend on, for the record of how the file was made. `part` is the word for the parts of a row
/// that may fail, such as "model". Throws Error(kNotConverged) after all is written if every part
/// failed in every row, Error(kBadInput) if the written file cannot be read again, and the errors
/// of write_rows().
void run_sweep(const sweep::Study& study, const SweepStageRequest& request,
               const results::Inputs& inputs, const std::string& part);

/// Computes the missing rows, writes the file of rows, and returns the number of rows that it
/// computed, which is 0 if none was missing. After each row, `progress` is called with the number
/// of finished rows and the number of all rows, by one thread at a time. Throws Error(kBadInput) if
/// a file of `inputs` cannot be read, Error(kWrongUsage) if the environment variable
/// SOURCE_DATE_EPOCH is not a time, and the errors of sweep::write_sweep(): Error(kInterrupted) if
/// `request.stop` requests a stop, Error(kBadInput) if the file cannot be written, and the errors
/// that Study::run throws, which end the sweep. Finished rows are kept.
std::uint64_t write_rows(const sweep::Study& study, const SweepStageRequest& request,
                         const results::Inputs& inputs,
                         const std::function<void(std::uint64_t, std::uint64_t)>& progress);

}  // namespace viscontact::pipeline
