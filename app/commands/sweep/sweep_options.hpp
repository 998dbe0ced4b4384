// The options of `sweep`, and one function for each kind of case that turns them into a study.
// Options of the command line take precedence over the section [sweep] of the case.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/case_file/case_template.hpp"
#include "viscontact/particle_runs/case/particles_study.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::app {

/// The values of the options, each named after its option. An empty text or list, or 0 for samples
/// and draws, means that the option was not given; the section [sweep] of the case or a default
/// then decides. CLI11 requires case_file and output.
struct SweepOptions {
  std::string case_file,
      fit,                        ///< path of a fit file
      output,                     ///< path of the CSV file of the rows
      reference,                  ///< name of the model with which the others are compared
      x, y;                       ///< keys of the horizontal and vertical axis of the picture
  std::vector<std::string> vary,  ///< "KEY=RANGE" each (sweep/variation.hpp)
      models,
      columns;                   ///< columns of the rows that are drawn
  results::PictureRequest plot;  ///< without a path: none
  std::uint64_t samples = 0,     ///< number of random points, <= 1e12
      seed = 1,                  ///< of the random points; any 64-bit number
      draws = 0;                 ///< random arrangements of particles at a point, <= 1e9
  int jobs = default_jobs();     ///< number of rows at once, from 1 to 1024
  ArrayOptions array;            ///< how the rows are divided among the jobs of a cluster
  bool dry_run = false,          ///< says how long the rows take, computes none
      json = false,              ///< --dry-run prints JSON
      keep_runs = false;         ///< keeps the files of runs of particles
  const CLI::Option* jobs_option = nullptr;  ///< CLI11's object; count() 0: not given
};

/// The study of a case with the options, and what the files and messages of the sweep need.
struct CaseStudy {
  sweep::Study study{};
  std::vector<std::filesystem::path> files{};  ///< the inputs, which the output records
  std::string part{};                          ///< what may fail in a row: "model", "stroke", "run"
  case_file::SweepRequest request{};           ///< the section [sweep] of the case
  std::vector<std::string> columns{};          ///< drawn if nothing else is asked for
};

/// Each of these functions makes the study of the case o.case_file, which must be of the kind in
/// the name of the function. They throw Error(kWrongUsage) for options that this kind does not
/// have, for a wrong --vary, and if neither --fit nor (for one sphere or a rolling one) the case
/// gives a fit; and Error(kBadInput) if case or fit is wrong, or if o.output is a file that is not
/// the output of a sweep of this kind.
CaseStudy study_of_sphere(const SweepOptions& o);
CaseStudy study_of_swimmer(const SweepOptions& o);
CaseStudy study_of_rolling_sphere(const SweepOptions& o);

/// The points of a sweep of a case of many particles, and how their rows are computed. Throws
/// Error(kWrongUsage) for options that this kind does not have, for a wrong --vary, and if nothing
/// is varied; and Error(kBadInput) if the case is wrong, or if o.output, or the table of means
/// beside it, is a file of another kind.
particles::ParticlesSweep sweep_of_particles(const SweepOptions& o);
/// The study of the rows of `sweep`, for a picture only: it cannot compute rows. Throws
/// Error(kBadInput) if the case is wrong.
CaseStudy study_of_particles(const particles::ParticlesSweep& sweep);
/// Computes the rows here, submits them to a cluster (--launcher slurm), computes the rows of one
/// task (--task), or collects finished rows (--gather). With --dry-run it only prints how long the
/// rows take. Throws Error(kNotConverged) if all rows failed, or with --gather if rows are missing;
/// Error(kExternalProgram) if Slurm fails; Error(kBadInput) if a file cannot be written; and
/// Error(kInterrupted) after Ctrl-C. One failed row among others is no error.
void sweep_many_particles(const SweepOptions& o, const particles::ParticlesSweep& sweep);

}  // namespace viscontact::app
