// What the command line of `sweep` says, and the studies between which the kind of the case
// decides.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/app/arguments/array_options.hpp"
#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/case_file/case_template.hpp"
#include "viscontact/sweep/study.hpp"

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

/// The study of a case with these options, and what the command says about it.
struct CaseStudy {
  sweep::Study study{};
  std::vector<std::filesystem::path> files{};  ///< the inputs
  std::string part{};                          ///< what a row computes several of, as "model"
  case_file::SweepRequest request{};           ///< the section [sweep] of the case
  std::vector<std::string> columns{};  ///< columns that are drawn if nothing else is asked for
};

/// Each of these makes the study of a kind of case. Throws Error(kWrongUsage) for options that this
/// kind does not have, and Error(kBadInput) if o.output is a file that is no sweep of this kind.
CaseStudy study_of_sphere(const SweepOptions& o);
CaseStudy study_of_swimmer(const SweepOptions& o);
CaseStudy study_of_rolling_sphere(const SweepOptions& o);

/// Runs, gathers or submits a sweep of a case of many particles.
void sweep_many_particles(const SweepOptions& o);

}  // namespace viscontact::app
