// The stages of sweeps of particles: simulations of one case with varied numbers. Each row of the
// table is the result of one simulation, which has a folder of its own (particles_run.hpp). Either
// this process computes all rows, or each task of a job on a cluster (Slurm) computes some of them
// and gather_sweep() writes the tables. The command `sweep` of app/ calls these functions. Numbers
// are in the units of the case. A run that fails does not stop the others; if all fail, or if rows
// are missing where they are gathered, Error(kNotConverged) is thrown. A change must not delete the
// result of a finished simulation, because a later call reads it instead of computing the row
// again.
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/case/particles_study.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"

namespace viscontact::particles {

/// The options of a sweep of particles.
struct ParticlesSweepRequest {
  std::string output;  ///< file of the rows (CSV); OUTPUT.runs/ has the folders
  int jobs = 1;        ///< number of rows that are computed at once, >= 1
  /// Whether all files of a finished simulation are kept. If not, only the case, the result,
  /// run.json and steps.csv are; a simulation that failed keeps all.
  bool keep_all = false;
  StartFluidSolver start_solver;  ///< starts the fluid solver; used if the case has a fluid
  StopToken stop{};               ///< ends the sweep; finished simulations are kept
};

/// Computes the missing rows, and writes the file of the rows and, if there are draws, the table of
/// means. A row that fails does not stop the others; the column `failure` says why it failed.
/// Throws Error(kNotConverged) after all is written if every run failed, Error(kInterrupted) if
/// `stop` requests a stop, and Error(kBadInput) if a file cannot be read or written or another
/// process computes the same row; finished runs are kept.
void sweep_particles(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Computes the rows of one task, those whose number modulo `share.count` is `share.number`, into
/// their folders, and writes no table. Throws the errors of sweep_particles(), for the rows of this
/// task.
void share_of_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                    const pipeline::Share& share);

/// Writes the tables from the runs that have ended, and runs nothing. Throws Error(kNotConverged)
/// if rows are missing, with their number and the first one, or if every run failed, and
/// Error(kBadInput) if a file cannot be read or written.
void gather_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Submits a Slurm job with the tasks that have rows to compute (array_job.hpp, which says what is
/// thrown), or none if no row is missing. Also throws Error(kBadInput) if the file of the rows
/// exists and is no regular file, and Error(kWrongUsage) if ArrayRequest::options has an open
/// quotation mark. `options` are the words of the command line that determine the rows, such as
/// --draws and its number.
void submit_sweep(const ParticlesSweep& sweep, const pipeline::ArrayRequest& request,
                  const std::vector<std::string>& options);

/// The estimate for --dry-run: how many rows are finished, and the computing time of a row [s].
/// This is the mean of the runs that have succeeded. If there are none, the first steps of the
/// first row are computed for two seconds, and the time of all of its steps is extrapolated from
/// them; nothing is written. Throws the errors of these steps.
pipeline::DryRun dry_run(const ParticlesSweep& sweep, const std::string& output,
                         const StartFluidSolver& start_solver, const StopToken& stop);

}  // namespace viscontact::particles
