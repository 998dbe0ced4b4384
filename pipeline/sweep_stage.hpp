// The stage sweep: computes the rows of a study (sweep/study.hpp) and writes them into a CSV file.
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
  int jobs = 1;        ///< number of rows that are computed at once, >= 1
  StopToken stop{};
};

/// Calls write_rows(), shows the progress on the terminal, and says there how many rows there are
/// and how many failed. `part` is the word for the parts of a row that may fail, such as "model".
/// Throws Error(kNotConverged) after all is written if every part failed in every row,
/// Error(kBadInput) if the written file cannot be read again, and the errors of write_rows().
void run_sweep(const sweep::Study& study, const SweepStageRequest& request,
               const results::Inputs& inputs, const std::string& part);

/// Computes the missing rows, writes the file of rows, and returns the number of rows that it
/// computed. Finished rows are never computed again. If a row fails, its column `failure` says why.
/// `inputs` are the files that the rows depend on, for the record of how the file was made. After
/// each row, `progress` is called with the number of finished rows and the number of all rows, by
/// one thread at a time. Throws Error(kBadInput) if a file of `inputs` cannot be read,
/// Error(kWrongUsage) if SOURCE_DATE_EPOCH is not a time, and the errors of sweep::write_sweep():
/// Error(kInterrupted) at a stop, Error(kBadInput) if the file cannot be written, and the errors of
/// Study::run, which end the sweep.
std::uint64_t write_rows(const sweep::Study& study, const SweepStageRequest& request,
                         const results::Inputs& inputs,
                         const std::function<void(std::uint64_t, std::uint64_t)>& progress);

}  // namespace viscontact::pipeline
