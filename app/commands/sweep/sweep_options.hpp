// What the command line of `sweep` says, and the three kinds of sweeps that the kind of the case
// decides between.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/app/arguments/array_options.hpp"
#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/sweep/rows.hpp"
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

/// Runs a sweep over the strokes of a swimmer, and draws its picture.
void sweep_swimmer(const SweepOptions& o);

/// Computes the rows that o.output does not have yet, and says how many there are and how many
/// failed. `files` are the inputs, and `what` a row computes: "model" or "stroke". Throws
/// Error(kNotConverged) if every row failed.
void write_rows(const SweepOptions& o, const sweep::Rows& rows,
                const std::vector<std::filesystem::path>& files, const std::string& what);

/// Runs, gathers or submits a sweep of a case of many particles.
void sweep_many_particles(const SweepOptions& o);

}  // namespace viscontact::app
