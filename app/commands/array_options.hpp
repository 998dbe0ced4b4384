// The options of commands whose rows can be computed by an array job on a Slurm cluster
// (docs/cluster.md): --launcher, --tasks, --slurm-options, --gather and --task. `tabulate` and
// `sweep` have them. A change must keep their names, because submitted scripts contain them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "viscontact/common/error.hpp"
#include "viscontact/pipeline/slurm/array_job.hpp"

namespace viscontact::app {

/// The values of these options.
struct ArrayOptions {
  std::string launcher = "local",  ///< "local" or "slurm"
      slurm_options,               ///< words for sbatch, quoted as in a shell; may be empty
      task;                        ///< "K/T": task K of T, 0 <= K < T; empty: no task
  std::size_t tasks = 0;           ///< number of tasks; 0: one for each row, at most 1000
  bool gather = false;             ///< true: puts the tables together, computes no row
  /// CLI11's objects of the options, for `excludes`.
  CLI::Option *launcher_option = nullptr, *gather_option = nullptr, *task_option = nullptr;

  bool is_slurm() const { return launcher == "slurm"; }  ///< whether a job is submitted
};

/// Adds the options. `results` is what --help calls the output of the command: "the tables".
void add_array_options(CLI::App& command, ArrayOptions& o, const std::string& results);

/// Throws Error(kWrongUsage) if options are given that only --launcher slurm uses, or if --task is
/// not K/T with 0 <= K < T.
void check_array_options(const ArrayOptions& o);

/// The rows that --task asks for; all rows if the option is not given.
pipeline::Share share_of(const ArrayOptions& o);

/// The request that these options make, for an array job that computes the rows of `output`.
/// `jobs_option` is CLI11's object of --jobs, and `jobs` its value, the number of rows at once in a
/// task.
pipeline::ArrayRequest array_request(const ArrayOptions& o, const std::string& output,
                                     const CLI::Option& jobs_option, int jobs);

/// Calls `call`. If it throws Error(kNotConverged), because rows are missing, or
/// Error(kExternalProgram), because Slurm failed, `remedy` is appended to the message.
template <class Call>
void with_remedy(std::string_view remedy, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotConverged && error.kind() != ErrorKind::kExternalProgram)
      throw;
    throw Error(error.kind(), std::string(error.what()) + "; " + std::string(remedy));
  }
}

/// The options that help if a submission or --gather fails, for with_remedy().
inline constexpr std::string_view kRemedyOfSlurm =
    "see --slurm-options, --tasks, or leave out --launcher slurm";
inline constexpr std::string_view kRemedyOfGather =
    "the same command without --gather computes the missing rows here, or with --launcher slurm or "
    "--task elsewhere";

}  // namespace viscontact::app
