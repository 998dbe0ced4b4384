// The record of the steps of a simulation of many particles, for steps.csv and run.json
// (docs/file-formats.md). Times [T] are in the unit of the case, computing times in seconds. A
// change must keep earlier files readable.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "viscontact/particles/case/particles_case.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

/// Sums and largest values over the steps of a run: those of this call and those of the interrupted
/// calls before it in the same folder.
struct StepTotals {
  /// Number of the last step. A run that continues another by --restart counts on from its steps.
  std::int64_t last_step = 0;
  /// Number of steps, of steps that did not converge, and of the iterations of all steps.
  std::int64_t steps = 0, unconverged = 0, iterations = 0;
  int most_iterations = 0;                           ///< largest number of iterations in one step
  double first_time = 0, last_time = 0;              ///< at the start and after the last step [T]
  double largest_residual = 0, largest_overlap = 0;  ///< divided by the mean radius
  double largest_impulse_residual = 0;               ///< divided by the impulses at work
  std::int64_t divided = 0;                          ///< steps that were divided into parts
  std::int64_t unresolved = 0;                       ///< sum of StepReport::unresolved
  double seconds = 0;                                ///< computing time of earlier calls [s]
  double peak_memory_mebibytes = 0;                  ///< of earlier calls [MiB]
  // With a fluid only.
  bool has_fluid = false;
  double fluid_seconds = 0;    ///< sum of FluidStepReport::seconds [s]
  std::uint64_t unknowns = 0;  ///< of the fluid solver, in the last step
  /// Estimates of the relative errors of velocities and forces at the first and at the last step.
  RelativeErrors first_velocity_errors, last_velocity_errors;
  RelativeErrors first_force_errors, last_force_errors;
};

/// The sums and the rows of steps.csv, which can be 50 MB long.
struct StepRecord : StepTotals {
  /// `has_fluid`: whether the rows have the columns of a fluid. `has_inertia`: whether they have
  /// those of a fluid with inertia, too.
  explicit StepRecord(bool has_fluid = false, bool has_inertia = false);

  std::string rows;  ///< the header of steps.csv, and the rows so far
  bool has_inertia = false;

  /// Adds a step to the sums and, if steps.csv lists it, to the rows. After a million steps, only
  /// every thousandth step and the steps that did not converge are listed.
  void add(std::int64_t step, const StepReport& report);
};

/// The comment line of steps.csv that contains the sums.
std::string record_comment(const StepTotals& sums);

/// The text of run.json at the end of a run with these sums.
std::string run_json(const ParticlesCase& c, const StepTotals& record, const State& state);

/// Reads from steps.csv the record as it was after the step `last_step` (0: before the first step).
/// The file may contain later rows, because it is written before restart.bin; they are left out.
/// Throws Error(kBadInput) if the file has no record of this step, or if the number of its rows
/// differs from that in the record.
StepRecord read_step_record(const std::filesystem::path& path, std::int64_t last_step,
                            bool has_fluid);

}  // namespace viscontact::particles
