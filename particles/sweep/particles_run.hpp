// Computes the rows of a sweep of particles. Each row is a run of one case in a folder of its own,
// and the results of the row are kept there, in the units of the case. particles_sweep_stage.cpp
// uses this class. If a run fails, nothing is thrown, and the result of the row says why.
// Error(kBadInput) is thrown if a file cannot be read or written, Error(kInterrupted) at a stop. A
// change must keep that a finished row is not computed again, and that results of another case or
// version are not taken.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/case/particles_study.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"

namespace viscontact::particles {

/// The folder OUTPUT.runs, which has a folder for each row, where OUTPUT is the path `output` of
/// the file of the rows. Nothing is made on the disk.
std::filesystem::path runs_folder(const std::filesystem::path& output);

/// Runs the cases of the rows of a sweep of particles in folders below runs_folder(). The folder of
/// a row is POINT, the number of its point, or with several random arrangements (draws) POINT-DRAW,
/// so that it stays the same if draws are added. It has
///
///     case.toml     the case of the row
///     result.json   keys "case_and_version" (hash), "values" (columns of the row), "failure" (why
///                   the run failed, or ""); written when the run has ended
///     run/          the files of the run; if it succeeded, only run.json and steps.csv are kept,
///                   unless `keep_all` is true
class ParticlesRuns {
 public:
  /// The sweep must outlive this object. `output` is the path of the file of the rows, `version`
  /// the version of Viscontact. `threads` >= 1 (not checked) is the number of threads of each run.
  /// If `keep_all` is true, all files of finished runs are kept. `start_solver` starts the fluid
  /// solver; it may be empty if the case has no fluid.
  ParticlesRuns(const ParticlesSweep& sweep, const std::filesystem::path& output,
                std::string version, int threads, bool keep_all, StartFluidSolver start_solver);

  /// The results of row `index` if its run has ended. Nothing if it has not, or if result.json is
  /// damaged or belongs to another case or version. In this class `index` counts from 0 and must be
  /// less than the number of rows (not checked). All functions may be called by several threads.
  /// Throws Error(kBadInput) if result.json or the CSV file of particles that the case names cannot
  /// be read.
  std::optional<sweep::RowResults> ended(std::uint64_t index) const;

  /// True if the run of row `index` has ended without a failure. Then compute() does not repeat the
  /// run. Throws the errors of ended().
  bool has_succeeded(std::uint64_t index) const;

  /// Runs the case of row `index`, continues the run if it was interrupted, or takes the results of
  /// a run that has succeeded. A run that failed before is run again. If the case is wrong, a step
  /// does not converge or the fluid solver fails, the results say so in `failure`. Throws
  /// Error(kInterrupted) if `stop` requests a stop, and Error(kBadInput) if the folder cannot be
  /// written or another process computes the same row.
  sweep::RowResults compute(std::uint64_t index, const StopToken& stop) const;

  /// The computing time of the run of row `index` [s]; 0 if it has not ended or run.json is
  /// damaged.
  double seconds(std::uint64_t index) const;

  const std::filesystem::path& folder() const { return folder_; }  ///< runs_folder() of the output

 private:
  std::filesystem::path folder_of(std::uint64_t index) const;

  const ParticlesSweep& sweep_;
  std::filesystem::path folder_;
  std::string version_;
  int threads_;
  bool keep_all_;
  StartFluidSolver start_solver_;
};

}  // namespace viscontact::particles
