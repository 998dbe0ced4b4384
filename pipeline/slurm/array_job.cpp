// The tasks of an array job, their script, and the calls of Slurm's programs squeue and sbatch.
#include "viscontact/pipeline/slurm/array_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

// The number of a task must be smaller than MaxArraySize of Slurm, which is 1001 by default.
constexpr std::size_t kMostTasks = 1000;

/// Without a slash at its end.
fs::path absolute_output(const fs::path& output) {
  const fs::path whole = fs::absolute(output).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // "folder/" becomes "folder"
}

/// The name depends on the path of the output only, so that refuse_second_job() finds an earlier
/// job for the same output.
std::string job_name(const fs::path& output) {
  constexpr std::size_t kDigits = 12;  // of the hash: 48 bits, enough to distinguish outputs
  return "viscontact-" + sha256(absolute_output(output).string()).substr(0, kDigits);
}

/// Runs a program of Slurm and returns its output without newlines at the end. The message
/// recommends the command `here` of Viscontact in place of Slurm. Throws Error(kExternalProgram) if
/// the program cannot be run or fails, and Error(kInterrupted) at a stop.
std::string ask_slurm(const std::vector<std::string>& command, const std::string& here,
                      const StopToken& stop) {
  auto result = run_process(command, {}, {}, {}, {}, stop);
  while (!result.output.empty() && result.output.back() == '\n') result.output.pop_back();
  std::string said;
  for (const char character : result.output)
    said += character == '\n' ? " | " : std::string(1, character);
  if (!result.started)
    throw Error(ErrorKind::kExternalProgram,
                "{} cannot be run ({}); submit where Slurm is installed (apt-get install "
                "slurm-client), or {} here",
                command.front(), said, here);
  if (result.exit_status != 0)
    throw Error(ErrorKind::kExternalProgram,
                "{} failed (exit status {}): {}; nothing was submitted", command.front(),
                result.exit_status, said);
  return result.output;
}

/// The numbers of the tasks as sbatch --array reads them, for example "0-3,7". Consecutive numbers
/// are written as a range, because sbatch limits the length of this text.
std::string array_of(const std::vector<std::size_t>& tasks) {
  assert(std::ranges::is_sorted(tasks));
  std::string text;
  for (std::size_t first = 0, last = 0; first < tasks.size(); first = last + 1) {
    for (last = first; last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1;) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(tasks[first]);
    if (last > first) text += fmt::format("-{}", tasks[last]);
  }
  return text;
}

/// The shell script of a task, which runs this program on the copies of the cases.
std::string task_script(const ArrayJob& job, const ArrayRequest& request) {
  std::vector<std::string> copies;
  for (const auto& [name, text] : job.copies)
    copies.push_back((slurm_folder(request.output) / name).string());
  return fmt::format(
      "#!/bin/sh\n# One task of the array; made by viscontact.\nexec {} {}{} -o {}{} --jobs {} "
      "--task \"$SLURM_ARRAY_TASK_ID/{}\"\n",
      shell_word(fs::read_symlink("/proc/self/exe").string()), job.command, shell_arguments(copies),
      shell_word(absolute_output(request.output).string()), shell_arguments(job.options),
      request.jobs.value_or(1), job.count);
}

/// In the names of the logs, sbatch replaces %A by the number of the job, %a by the number of the
/// task, and %% by %.
std::string log_pattern(const fs::path& folder) {
  std::string pattern;
  for (const char character : folder.string())
    pattern += character == '%' ? "%%" : std::string(1, character);
  return pattern + "/%A_%a.log";
}

/// Puts the results together after the job is over; for the user.
std::string gather_command(const ArrayJob& job, const ArrayRequest& request) {
  return fmt::format("viscontact {}{} -o {}{} --gather", job.command, shell_arguments(job.cases),
                     shell_word(request.output.string()), shell_arguments(job.options));
}

}  // namespace

std::size_t task_count(const ArrayRequest& request, std::size_t rows) {
  assert(!request.tasks || *request.tasks >= 1);
  return request.tasks.value_or(std::min(rows, kMostTasks));
}

fs::path slurm_folder(const fs::path& output) {
  return absolute_output(output).string() + ".slurm";
}

void refuse_second_job(const ArrayJob& job, const ArrayRequest& request) {
  std::string jobs =
      ask_slurm({"squeue", "--noheader", "--format=%F", "--states=PENDING,RUNNING,SUSPENDED",
                 "--name=" + job_name(request.output)},
                job.command, request.stop);
  if (jobs.empty()) return;
  const std::string number = jobs.substr(0, jobs.find('\n'));
  throw_bad_input(
      {request.output.string()},
      "{0} by Slurm job {1}; wait until it is over (squeue -j {1}), or end it (scancel {1})",
      job.is_running, number);
}

void submit(const ArrayJob& job, const ArrayRequest& request) {
  assert(std::ranges::all_of(job.tasks, [&](std::size_t task) { return task < job.count; }));
  const auto options = split_words(request.options);
  const std::string gather = gather_command(job, request);
  if (job.tasks.empty()) {
    terminal::say("{}: no row is missing; this command writes {}: {}", job.command, job.results,
                  gather);
    return;
  }
  const auto folder = slurm_folder(request.output);
  for (const auto& [name, text] : job.copies) write_file(folder / name, text);
  const auto script = folder / "task.sh";
  write_file(script, task_script(job, request));

  // With --requeue, Slurm runs the tasks of a node that fails again. The options of the user follow
  // --requeue on the command line, so that they can override this option.
  std::vector<std::string> command = {"sbatch", "--requeue"};
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"--parsable", "--job-name=" + job_name(request.output),
                                 "--array=" + array_of(job.tasks), "--open-mode=append",
                                 "--output=" + log_pattern(folder)});
  if (request.jobs) command.push_back(fmt::format("--cpus-per-task={}", *request.jobs));
  command.push_back(script.string());
  std::string number = ask_slurm(command, job.command, request.stop);
  // If there are several clusters, sbatch prints "number;cluster".
  number = number.substr(0, number.find(';'));
  terminal::say(
      "{}: Slurm job {} with {} tasks is submitted; its logs are in {}; when it is over (squeue -j "
      "{}), run:\n  {}",
      job.command, number, job.tasks.size(), folder.string(), number, gather);
  fmt::print("{}\n", number);
}

}  // namespace viscontact::pipeline
