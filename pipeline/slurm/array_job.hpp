// Array jobs of the workload manager Slurm (docs/cluster.md), whose tasks each compute a share of
// the rows of a table or of a sweep.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// The rows that one task computes: those whose number, from 0, modulo `count` is `number`.
struct Share {
  std::size_t number = 0,  ///< < count
      count = 1;           ///< number of tasks, >= 1; 1: all rows
};

/// The options of a command that submits an array job.
struct ArrayRequest {
  std::filesystem::path output;      ///< path of the command's output: a table or a folder
  std::optional<std::size_t> tasks;  ///< number of tasks, >= 1; nothing: task_count() chooses it
  std::optional<int> jobs;           ///< rows that a task computes at once, >= 1; nothing: 1
  std::string options;               ///< further words for sbatch, quoted as in a shell; or empty
  StopToken stop{};                  ///< ends the wait for Slurm
};

/// What an array job computes.
struct ArrayJob {
  std::string command;     ///< command of Viscontact that a task runs: "tabulate" or "sweep"
  std::string is_running;  ///< words for messages after the output's name: "is being tabulated"
  std::string results;     ///< words for the output in messages: "the tables"
  std::vector<std::string> cases;  ///< paths of the case files
  /// Names and contents of the copies that the tasks run, so that cases may be edited.
  std::vector<std::pair<std::string, std::string>> copies;
  std::vector<std::string> options;  ///< further arguments of the command, each one word
  std::size_t count = 1;             ///< number of tasks
  std::vector<std::size_t> tasks;    ///< increasing numbers, < count, of tasks with rows to compute
};

/// The number of tasks that the request names, or one for each of `rows`, but at most 1000, because
/// Slurm allows task numbers up to 1000 by default.
std::size_t task_count(const ArrayRequest& request, std::size_t rows);

/// OUTPUT.slurm, as an absolute path, with copies of the cases, the script and the logs of tasks.
std::filesystem::path slurm_folder(const std::filesystem::path& output);

/// Throws Error(kBadInput) if Slurm has a job for this output that is not over,
/// Error(kExternalProgram) if Slurm cannot be asked, and Error(kInterrupted) at a stop. Must be
/// called before the missing rows are listed, because a job that is not over can still compute some
/// of them.
void refuse_second_job(const ArrayJob& job, const ArrayRequest& request);

/// Writes the folder slurm_folder(), submits the job and prints its number to standard output; does
/// nothing if `job.tasks` is empty. Throws Error(kExternalProgram) with the message of Slurm if
/// Slurm is missing or refuses the job, Error(kBadInput) if a file cannot be written,
/// Error(kWrongUsage) if a quotation mark in `request.options` is not closed, and
/// Error(kInterrupted) at a stop.
void submit(const ArrayJob& job, const ArrayRequest& request);

}  // namespace viscontact::pipeline
