// What --dry-run prints: how many rows a command would compute and about how long that takes.
#pragma once

#include <string>
#include <vector>

#include "viscontact/pipeline/tabulate_stage.hpp"
#include "viscontact/sweep/sweep.hpp"

namespace viscontact {

/// The rows of one output.
struct DryRun {
  std::string output;
  std::uint64_t rows = 0,
                finished = 0;  ///< finished ones are there and would not be computed again
  double seconds_per_row = 0;  ///< of one core
  std::string basis;           ///< what that is taken from, in words
};

/// Of a table. The time is the mean of its finished rows, else that of the shipped tables: of the right order on a machine like theirs.
DryRun dry_run(const CaseTable& one);

/// Of a sweep into a file, by computing three of its rows.
DryRun dry_run(const Sweep& sweep, const std::string& output);

/// A line for each, the time for all of them with `jobs` at once; as JSON, if asked for.
std::string dry_run_text(const std::vector<DryRun>& runs, int jobs, bool json);

}  // namespace viscontact
