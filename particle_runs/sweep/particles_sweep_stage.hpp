// Sweeps of particles: one case is simulated again and again with other values of some of its
// numbers, in this process or in the tasks of a job on a cluster (Slurm).
#pragma once

#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particle_runs/case/particles_study.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"

namespace viscontact::particles {

/// The options of a sweep of particles. Each row of the table is the result of one simulation.
struct ParticlesSweepRequest {
  std::string output;  ///< file of the rows (CSV); OUTPUT.runs/ has the folders of the simulations
  int jobs = 1;        ///< number of rows that are computed at once, >= 1
  /// False: of a finished simulation that did not fail, only the case, the result, run.json and
  /// steps.csv are kept.
  bool keep_all = false;
  StartFluidSolver start_solver;  ///< may be empty if there is no fluid
  StopToken stop{};               ///< finished simulations are kept
};

/// Computes the missing rows, and writes the file of the rows and, if the sweep repeats each point
/// with several random arrangements (draws), the table of means over them. A row that fails does
/// not stop the others; the column `failure` says why it failed. Throws Error(kNotConverged) after
/// all is written if every run failed, Error(kInterrupted) if `stop` requests a stop, and
/// Error(kBadInput) if a file cannot be read or written or another process computes the same row.
void sweep_particles(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Computes the rows of one task into their folders, and writes no table. The task has the rows
/// whose number, from 0, modulo `share.count` is `share.number`; it may have none. Throws as
/// sweep_particles() does.
void share_of_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                    const pipeline::Share& share);

/// Writes the tables from the runs that have ended, and runs nothing. Throws Error(kNotConverged)
/// if rows are missing or if every run failed, Error(kInterrupted) if `request.stop` requests a
/// stop, and Error(kBadInput) if a file cannot be read or written.
void gather_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Submits a Slurm job with the tasks that have rows to compute, or no job if no row is missing.
/// `options` are the words of the command line that determine the rows, such as --draws and its
/// number. Throws Error(kBadInput) if an earlier job for the same output is not over, if a file
/// cannot be read or written, or if the file of the rows exists and is no regular file,
/// Error(kExternalProgram) if Slurm is missing or refuses the job, Error(kWrongUsage) if
/// ArrayRequest::options has an open quotation mark, and Error(kInterrupted) if `request.stop`
/// requests a stop.
void submit_sweep(const ParticlesSweep& sweep, const pipeline::ArrayRequest& request,
                  const std::vector<std::string>& options);

/// The estimate for --dry-run into the file of rows `output`: how many rows are finished, and the
/// computing time of a row [s]. The time is the mean over the runs that have succeeded. If there
/// are none, steps of the first row are timed at the beginning, in the middle and at the end of its
/// motion, for about a second each; longer steps lead from one of these times to the next. Nothing
/// is written. Throws Error(kBadInput) if a file cannot be read or the case of the first row is
/// wrong, Error(kNotConverged) if one of these steps cannot be computed, Error(kExternalProgram) if
/// the fluid solver fails, and Error(kInterrupted) if `stop` requests a stop while that solver
/// computes.
pipeline::DryRun dry_run(const ParticlesSweep& sweep, const std::string& output,
                         const StartFluidSolver& start_solver, const StopToken& stop);

}  // namespace viscontact::particles
