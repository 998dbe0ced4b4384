// The CSV file of a sweep (docs/file-formats.md). It is written row by row, so that a later call
// can continue an interrupted sweep after its last row.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "viscontact/sweep/rows.hpp"

namespace viscontact::sweep {

/// Computes the missing rows of a sweep and writes them into a CSV file. Until all rows are
/// finished, they are in PATH.part, in order. A later call keeps the rows in that file if they
/// belong to the same sweep (Rows::comments), and otherwise deletes them. A finished file of the
/// same sweep is left as it is. `how_made` is empty or a line "# provenance: ...\n" for the head of
/// a new file. `progress(done, size)` is called after each row.
///
/// Throws Error(kInterrupted) if `stop` requests a stop, and Error(kBadInput) if a file cannot be
/// written or another process writes the same file. Returns the number of rows that were computed.
std::uint64_t write_sweep(
    const Rows& rows, const std::filesystem::path& path, int jobs, const std::string& how_made,
    const std::function<void(std::uint64_t done, std::uint64_t size)>& progress,
    const StopToken& stop = {});

/// How many points of a finished sweep have results, and why others have none.
struct SweepOutcome {
  std::uint64_t points = 0;          ///< number of all points
  std::uint64_t without_result = 0;  ///< number of points at which everything failed
  /// Number of points with a failure and some results, for example of models that did not fail.
  std::uint64_t with_some_results = 0;
  /// Column `failure` of the first point that has one; may be empty.
  std::string first_failure;
};

/// Reads from the finished file of a sweep with these rows how many points have results. Throws
/// Error(kBadInput) if the file cannot be read.
SweepOutcome read_outcome(const Rows& rows, const std::filesystem::path& path);

/// Number of rows of this sweep that are finished, in PATH or PATH.part.
std::uint64_t finished_rows(const Rows& rows, const std::filesystem::path& path);

}  // namespace viscontact::sweep
