// The stages of sweeps. run_sweep computes the rows of any study. Those of a sweep of particles are
// runs with folders of their own, which this process computes, or each task of a job on a cluster
// computes a share of them; then gather_sweep puts the tables together. Numbers of rows are in the
// units of the case.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/pipeline/array_job.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/sweep/particles_study.hpp"

namespace viscontact::pipeline {

/// What is asked of a sweep, besides its study.
struct SweepStageRequest {
  std::string output;     ///< file of the rows
  int jobs = 1;           ///< number of rows that are computed at once, >= 1
  bool keep_all = false;  ///< true: the files of finished runs of particles are kept
  StopToken stop{};       ///< a stop throws Error(kInterrupted)
};

/// Computes the missing rows and writes their file, shows the progress, and says how many rows
/// there are and how many failed. A row has several parts, any of which may fail; `part` is their
/// name, such as "model". Throws Error(kNotConverged) after all is written if every part failed in
/// every row, and Error(kInterrupted) if `stop` requests a stop; finished rows are kept.
void run_sweep(const sweep::Study& study, const SweepStageRequest& request,
               const results::Inputs& inputs, const std::string& part);

/// Computes the missing rows, and writes the file of the rows and, if there are draws, the table of
/// means. A row that fails stops no other rows; column `failure` says why. Throws
/// Error(kNotConverged) after all is written if every run failed, and Error(kInterrupted) if `stop`
/// requests a stop; finished runs are kept.
void sweep_particles(const sweep::ParticlesSweep& sweep, const SweepStageRequest& request);

/// Computes the rows of a task, those whose number modulo `share.count` is `share.number`, into
/// their folders, and writes no table. Throws as sweep_particles does.
void share_of_sweep(const sweep::ParticlesSweep& sweep, const SweepStageRequest& request,
                    const Share& share);

/// Writes the tables from the runs that have ended, and runs nothing. Throws Error(kNotConverged),
/// which names rows, if some are missing.
void gather_sweep(const sweep::ParticlesSweep& sweep, const SweepStageRequest& request);

/// Submits the tasks that have rows to compute (array_job.hpp). `options` are the words of the
/// command line that determine the rows, such as --draws and its number.
void submit_sweep(const sweep::ParticlesSweep& sweep, const ArrayRequest& request,
                  const std::vector<std::string>& options);

/// The estimate for --dry-run. The time of a row is that of the runs that have ended. If there are
/// none, the first steps of the first row are computed, for two seconds or until `stop` requests a
/// stop, and the time of all of its steps is extrapolated from them; nothing is written. Throws the
/// errors of these steps.
DryRun dry_run(const sweep::ParticlesSweep& sweep, const std::string& output,
               const StopToken& stop);

}  // namespace viscontact::pipeline
