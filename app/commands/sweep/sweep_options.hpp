// What the command line of `sweep` says, and the two kinds of sweeps that the kind of the case
// decides between.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viscontact/app/arguments/array_options.hpp"
#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::app {

struct SweepOptions {
  std::string case_file, fit, output, reference, plot, x, y;
  std::vector<std::string> vary, models, columns;
  std::uint64_t samples = 0, seed = 1, draws = 0;
  int jobs = default_jobs();
  ArrayOptions array;
  bool dry_run = false, json = false, keep_runs = false;
  const CLI::Option* jobs_option = nullptr;  ///< CLI11's object of --jobs
};

/// The ranges of --vary. Throws Error(kWrongUsage) for a text that is no range.
std::vector<sweep::Variation> variations_of(const SweepOptions& o);

/// Runs a sweep of a case of one sphere, and draws its picture.
void sweep_sphere(const SweepOptions& o);

/// Runs, gathers or submits a sweep of a case of many particles.
void sweep_many_particles(const SweepOptions& o);

}  // namespace viscontact::app
