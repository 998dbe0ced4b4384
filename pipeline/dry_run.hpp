// The output of --dry-run: how many rows a command would compute and about how long that takes, in
// seconds of wall time. Nothing is written. `tabulate` and `sweep` print it. Errors are those of
// the rows that are computed. A change must keep the keys of the JSON, which scripts read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::pipeline {

/// How many rows one output has, and how long they take.
struct DryRun {
  std::string output;  ///< path of the table or of the sweep's file
  /// The number of all rows, and of those that are finished and would not be computed again.
  std::uint64_t rows = 0, finished = 0;
  std::uint64_t failed = 0;    ///< number of the unfinished rows that were tried and failed
  double seconds_per_row = 0;  ///< on one core [s]
  std::string basis;           ///< what seconds_per_row was estimated from, in words
};

/// The estimate for a table. The time of a row is the mean over the finished rows. If there are
/// none, it is the time that rows of the shipped tables took, which has the right order of
/// magnitude on a similar machine.
DryRun dry_run(const CaseTable& one);

/// The estimate for a sweep into the file `output`. Up to three of its rows are computed and timed.
DryRun dry_run(const sweep::Study& study, const std::string& output, const StopToken& stop);

/// A line for each output, then the time that all of them take if `jobs` rows are computed at once.
/// If `json` is true, the same as JSON.
std::string dry_run_text(const std::vector<DryRun>& runs, int jobs, bool json);

}  // namespace viscontact::pipeline
