// The output of --dry-run: how many rows a command would compute and about how long that takes, in
// seconds of wall time. Nothing is written. The commands `tabulate` and `sweep`, and
// particles/sweep, use it. Files that cannot be read throw Error(kBadInput), and rows that are
// computed for the estimate throw their errors. A change must keep the keys of the JSON, which
// users' scripts read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::pipeline {

/// How many rows one output of a command has, and how long they take.
struct DryRun {
  std::string output;      ///< path of the table or of the sweep's file
  std::uint64_t rows = 0,  ///< number of all rows
      finished = 0;        ///< number of the rows that would not be computed again, <= rows
  /// Number of unfinished rows that were tried and failed; 0 for sweeps other than of particles.
  std::uint64_t failed = 0;
  double seconds_per_row = 0;  ///< mean time of a row on one core [s], >= 0
  std::string basis;           ///< what seconds_per_row was estimated from, in words
};

/// The estimate for a table. The time of a row is the mean over the finished rows. If there are
/// none, it is the time that rows of the shipped tables took, which has the right order of
/// magnitude on a similar machine. A table of other inputs counts as no rows. Throws
/// Error(kBadInput) if the file of the table or of its finished rows cannot be read.
DryRun dry_run(const CaseTable& one);

/// The estimate for a sweep into the file `output`. The first, the middle and the last row are
/// computed and timed; a row in which models fail counts as computed. Throws the Errors of
/// Study::run, Error(kInterrupted) among them if `stop` requests a stop, and Error(kBadInput) if
/// `output` exists and is not a regular file.
DryRun dry_run(const sweep::Study& study, const std::string& output, const StopToken& stop);

/// A line for each output, then the time that all of them take if `jobs` rows are computed at once
/// (>= 1, not checked). If `json` is true, the same as a JSON object: "jobs", "seconds" [s] of all
/// missing rows, and "outputs", an array of objects, in the order of `runs`. Nothing is thrown.
std::string dry_run_text(const std::vector<DryRun>& runs, int jobs, bool json);

}  // namespace viscontact::pipeline
