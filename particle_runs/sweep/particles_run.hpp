// The rows of a sweep of particles: runs of one case with other values, in folders of their own.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particle_runs/case/particles_study.hpp"

namespace viscontact::particles {

/// The folder OUTPUT.runs for the path OUTPUT of the file of the rows. Nothing is made on the disk.
std::filesystem::path runs_folder(const std::filesystem::path& output);

/// Runs the cases of the rows of a sweep of particles in folders below runs_folder(). The folder of
/// a row is POINT, the number of its point, or with several random arrangements (draws) POINT-DRAW,
/// so that it stays the same if draws are added; both count from 0. It has
///
/// - case.toml, the case of the row
/// - result.json, with the keys "case_and_version" (hash), "values" (columns of the row), "failure"
///   (why the run failed, or ""); it is written when the run has ended, so that a process may be
///   killed at any time
/// - run/, the files of the run; if it succeeded, only run.json and steps.csv are kept, unless
///   `keep_all` is true
///
/// In all functions `index` is the number of a row, from 0. Several threads may call them.
class ParticlesRuns {
 public:
  /// The sweep must outlive this object. `output` is the path of the file of the rows, `version`
  /// the version of Viscontact. `threads` >= 1 is the number of threads of each run. `start_solver`
  /// may be empty if the case has no fluid.
  ParticlesRuns(const ParticlesSweep& sweep, const std::filesystem::path& output,
                std::string version, int threads, bool keep_all, StartFluidSolver start_solver);

  /// The results of a row if its run has ended. Nothing if it has not, or if result.json is damaged
  /// or belongs to another case or version. Throws Error(kBadInput) if result.json or the CSV file
  /// of particles that the case names cannot be read.
  std::optional<sweep::RowResults> ended(std::uint64_t index) const;

  /// True if the run has ended without a failure. Throws as ended() does.
  bool has_succeeded(std::uint64_t index) const;

  /// Runs the case of a row, continues the run if it was interrupted, or takes the results of a run
  /// that has succeeded. A run that failed before is run again. If the case is wrong, a step does
  /// not converge or the fluid solver fails, the results say so in `failure`. Throws
  /// Error(kInterrupted) if `stop` requests a stop, and Error(kBadInput) if the folder cannot be
  /// written or another process computes the same row.
  sweep::RowResults compute(std::uint64_t index, const StopToken& stop) const;

  /// The computing time of the run [s]; 0 if it has not ended or run.json is damaged.
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
