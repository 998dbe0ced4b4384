// The file of a sweep: written row by row, resumed where it was cut off.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "viscontact/sweep/sweep.hpp"

namespace viscontact {

/// Runs what is missing of a sweep into a CSV file. Until all rows are there they stand in PATH.part, in order, where an interrupted or killed sweep
/// finds them again: rows of the same case, fit, plan and version are kept, others thrown away. A file that is finished and the same is left as it is.
/// `how_made` is empty or a line "# provenance: ...\n" for the head of a new file.
/// `progress(done, size)` is called now and then. Throws Error(kInterrupted) when interrupted(), Error(kBadInput) if a file cannot be written.
/// Returns the number of rows that were computed.
std::uint64_t write_sweep(
    const Sweep& sweep, const std::filesystem::path& path, int jobs, const std::string& version,
    const std::string& how_made,
    const std::function<void(std::uint64_t done, std::uint64_t size)>& progress);

/// How the points of a finished sweep ended.
struct SweepOutcome {
  std::uint64_t points = 0;
  std::uint64_t without_result = 0;  ///< points at which every model failed
  std::uint64_t with_some_results =
      0;                      ///< points at which some models failed and others gave a result
  std::string first_failure;  ///< column `failure` of the first of all these points; may be empty
};

/// Reads from the finished file of a sweep with this plan how its points ended. Throws
/// Error(kBadInput) if the file cannot be read.
SweepOutcome read_outcome(const SweepPlan& plan, const std::filesystem::path& path);

/// The rows of that sweep that are finished in PATH or PATH.part.
std::uint64_t finished_rows(const Sweep& sweep, const std::filesystem::path& path,
                            const std::string& version);

}  // namespace viscontact
