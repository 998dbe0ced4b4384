// The stages of sweeps of particles: simulations of one case with varied numbers. Each row of the
// table is the result of one simulation, which has a folder of its own. Either this process
// computes all rows, or each task of a job on a cluster computes some of them and gather_sweep()
// writes the tables. The command `sweep` calls these functions. Numbers are in the units of the
// case. A change must not delete the result of a finished simulation, because a later call reads it
// instead of computing the row again.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/case/particles_study.hpp"
#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::particles {

/// The options of a sweep of particles.
struct ParticlesSweepRequest {
  std::string output;  ///< file of the rows (CSV); the folders are in OUTPUT.runs/
  int jobs = 1;        ///< number of rows that are computed at once, >= 1
  /// False: of the files of a simulation that has not failed only the case, the result, run.json
  /// and steps.csv are kept; true: all.
  bool keep_all = false;
  StartFluidSolver start_solver;  ///< used if the case has a fluid
  StopToken stop{};
};

/// Computes the missing rows, and writes the file of the rows and, if there are draws, the table of
/// means. A row that fails stops no other rows; column `failure` says why. Throws
/// Error(kNotConverged) after all is written if every run failed, and Error(kInterrupted) if `stop`
/// requests a stop; finished runs are kept.
void sweep_particles(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Computes the rows of a task, those whose number modulo `share.count` is `share.number`, into
/// their folders, and writes no table. Throws the errors of sweep_particles().
void share_of_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request,
                    const pipeline::Share& share);

/// Writes the tables from the runs that have ended, and runs nothing. Throws Error(kNotConverged),
/// which names rows, if some are missing.
void gather_sweep(const ParticlesSweep& sweep, const ParticlesSweepRequest& request);

/// Submits the tasks that have rows to compute (array_job.hpp). `options` are the words of the
/// command line that determine the rows, such as --draws and its number.
void submit_sweep(const ParticlesSweep& sweep, const pipeline::ArrayRequest& request,
                  const std::vector<std::string>& options);

/// The estimate for --dry-run. The time of a row is that of the runs that have ended. If there are
/// none, the first steps of the first row are computed, for two seconds or until `stop` requests a
/// stop, and the time of all of its steps is extrapolated from them; nothing is written. Throws the
/// errors of these steps.
pipeline::DryRun dry_run(const ParticlesSweep& sweep, const std::string& output,
                         const StartFluidSolver& start_solver, const StopToken& stop);

}  // namespace viscontact::particles
