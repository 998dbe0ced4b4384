// What is recorded of the steps of a simulation of many particles: steps.csv and run.json.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "viscontact/particles/simulation.hpp"

namespace viscontact {

/// Sums over the steps so far, of this call and of the interrupted ones before it in the same folder.
struct StepTotals {
  std::int64_t last_step = 0;  ///< of the state, counted from the very first start
  std::int64_t steps = 0, unconverged = 0, iterations = 0;
  int most_iterations = 0;
  double first_time = 0, last_time = 0;              ///< [T]
  double largest_residual = 0, largest_overlap = 0;  ///< over the mean radius
  double largest_impulse_residual = 0;               ///< over the impulses at work
  std::int64_t divided = 0;                          ///< steps that were divided into parts
  std::int64_t unresolved = 0;                       ///< the sum of StepReport::unresolved
  double seconds = 0;                                ///< of the calls before this one
  double peak_memory_mebibytes = 0;                  ///< of the calls before this one
};

/// The same, and the rows of steps.csv, which can be 50 MB long.
struct StepRecord : StepTotals {
  std::string rows =
      "step,time,contacts,glued,iterations,residual,largest_overlap,converged,impulse_residual,"
      "parts,unresolved\n";

  /// Takes a step into the sums and, if it is among those that are listed, into the rows.
  void add(std::int64_t step, const particles::StepReport& report);
};

/// A comment line for steps.csv that holds the sums.
std::string record_comment(const StepTotals& sums);

/// The record as it was after the step `last_step` (0: before the first step). The file may go on
/// beyond this step, because it is written before restart.bin: its later rows are left out. Throws
/// Error(kBadInput) if the file has no record of this step or its rows are not those of the record.
StepRecord read_step_record(const std::filesystem::path& path, std::int64_t last_step);

}  // namespace viscontact
