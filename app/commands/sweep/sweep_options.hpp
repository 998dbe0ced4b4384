// The options of `sweep`, and the functions that turn options into a study (the points of the sweep
// and the function that computes the row of a point), one for each kind of case. Numbers are in the
// units of the case. Wrong options throw Error(kWrongUsage), wrong files Error(kBadInput), both
// before a row is computed. A row that fails is no error unless all rows do. Used by the two
// sources of this folder. docs/command-line.md describes the options, whose names must stay.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/case_file/case_template.hpp"
#include "viscontact/particles/case/particles_study.hpp"
#include "viscontact/sweep/study.hpp"

namespace viscontact::app {

/// The values of the options, each named after its option. An empty text or list, or 0 for samples
/// and draws, means that the option was not given; the section [sweep] of the case or a default
/// then decides. The command line always gives case_file and output.
struct SweepOptions {
  std::string case_file,          ///< path of the case
      fit,                        ///< path of a fit file
      output,                     ///< path of the CSV file of the rows
      reference,                  ///< name of the model with which the others are compared
      x, y;                       ///< keys of the axes of the picture
  std::vector<std::string> vary,  ///< "KEY=RANGE" each (sweep/variation.hpp)
      models,                     ///< names of models
      columns;                    ///< columns that are drawn
  results::PictureRequest plot;   ///< the picture
  std::uint64_t samples = 0,      ///< number of random points, <= 1e12
      seed = 1,                   ///< seed of the random points; any number
      draws = 0;                  ///< random arrangements of particles at a point, <= 1e9
  int jobs = default_jobs();      ///< number of rows at once, from 1 to 1024
  ArrayOptions array;             ///< how the rows are divided among the jobs of a cluster
  bool dry_run = false,           ///< true: says how long the rows take, computes none
      json = false,               ///< true: says it in JSON
      keep_runs = false;          ///< true: keeps the files of runs of particles
  const CLI::Option* jobs_option = nullptr;  ///< tells whether --jobs was given
};

/// The study of a case with these options, and what is needed to write its files and messages.
struct CaseStudy {
  sweep::Study study{};                        ///< points, and how rows are computed
  std::vector<std::filesystem::path> files{};  ///< the inputs, for the provenance
  std::string part{};                          ///< what may fail in a row, for messages: "model"
  case_file::SweepRequest request{};           ///< the section [sweep] of the case
  std::vector<std::string> columns{};  ///< columns that are drawn if nothing else is asked for
};

/// Each of these functions makes the study of the case o.case_file, which must be of its kind. They
/// throw Error(kWrongUsage) for options that this kind does not have, for a wrong --vary, and if
/// neither --fit nor (for one sphere or a rolling one) the case gives a fit; and Error(kBadInput)
/// if case or fit is wrong, or if o.output is a file that is no sweep of this kind.
CaseStudy study_of_sphere(const SweepOptions& o);
CaseStudy study_of_swimmer(const SweepOptions& o);
CaseStudy study_of_rolling_sphere(const SweepOptions& o);

/// The rows of a sweep of a case of many particles. Throws Error(kWrongUsage) for options that this
/// kind does not have, for a wrong --vary, and if nothing is varied; and Error(kBadInput) if the
/// case is wrong, or if o.output or its table of means is another file.
particles::ParticlesSweep sweep_of_particles(const SweepOptions& o);
/// The study of these rows for a picture only: it cannot compute rows. Throws Error(kBadInput) if
/// the case is wrong.
CaseStudy study_of_particles(const particles::ParticlesSweep& sweep);
/// Computes the rows here, submits them to a cluster (--launcher slurm), computes those of one task
/// (--task), or collects finished rows (--gather). With --dry-run prints how long the rows take.
/// Throws Error(kNotConverged) if all rows failed, or with --gather if rows are missing;
/// Error(kExternalProgram) if Slurm fails; Error(kBadInput) if a file cannot be written; and
/// Error(kInterrupted) after Ctrl-C. One failed row among others is no error.
void sweep_many_particles(const SweepOptions& o, const particles::ParticlesSweep& sweep);

}  // namespace viscontact::app
