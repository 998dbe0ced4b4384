// Submits rows to the workload manager Slurm as one array job (docs/cluster.md): those of
// tabulations and of sweeps of particles. A change must keep that later edits of a case do not
// change a submitted job. Used by app/, particles/ and tabulate/.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/common/stop_token.hpp"

namespace viscontact::pipeline {

/// The rows of task `number` of `count` tasks: those whose number modulo `count` is `number`.
struct Share {
  std::size_t number = 0,  ///< number of the task, from 0, < count
      count = 1;           ///< number of tasks, >= 1; 1: all rows
};

/// The options of an array job.
struct ArrayRequest {
  std::filesystem::path output;      ///< output of the command
  std::optional<std::size_t> tasks;  ///< size of the array; nothing: one task a row, at most 1000
  std::optional<int> jobs;           ///< processes or runs at once in a task; nothing: 1
  std::string options;               ///< further words for sbatch, quoted as in a shell; or empty
  StopToken stop{};                  ///< a stop ends the wait for Slurm (kInterrupted)
};

/// What an array job computes.
struct ArrayJob {
  std::string command;     ///< of Viscontact: "tabulate" or "sweep"
  std::string is_running;  ///< what happens to the output, for a message: "is being tabulated"
  std::string results;     ///< what the output is in messages, such as "the tables"
  std::vector<std::string> cases;  ///< paths of the case files
  /// Names and contents of the copies of the cases, which the tasks run, so that later edits of the
  /// cases do not change them.
  std::vector<std::pair<std::string, std::string>> copies;
  std::vector<std::string> options;  ///< further words of the command
  std::size_t count = 1;             ///< number of tasks
  std::vector<std::size_t> tasks;    ///< numbers of the tasks that have rows to compute
};

/// The number of tasks: that of the request or, if it names none, one for each row, at most 1000.
std::size_t task_count(const ArrayRequest& request, std::size_t rows);

/// The folder OUTPUT.slurm, which has copies of the submitted cases, the script of a task and the
/// logs of the tasks.
std::filesystem::path slurm_folder(const std::filesystem::path& output);

/// Throws Error(kBadInput) if Slurm has a job for this output that is not over, and
/// Error(kExternalProgram) if Slurm cannot be asked. Call it before the missing rows are listed.
void refuse_second_job(const ArrayJob& job, const ArrayRequest& request);

/// Submits the job and prints its number to standard output. If there is no task, no job is
/// submitted and no number is printed. Throws Error(kExternalProgram) with the message of Slurm if
/// Slurm is missing or refuses the job.
void submit(const ArrayJob& job, const ArrayRequest& request);

}  // namespace viscontact::pipeline
