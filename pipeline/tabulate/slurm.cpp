// The array job of a tabulation: its tasks, its script and the calls of squeue and sbatch. Each
// task runs `viscontact tabulate --task K/T`, where K is the number of the task.
#include "viscontact/pipeline/tabulate/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/common/system/process.hpp"
#include "viscontact/common/text/shell_words.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

// Slurm's MaxArraySize is 1001 by default, and the number of each task must be smaller than it.
constexpr std::size_t kMostTasks = 1000;

fs::path absolute_output(const fs::path& output) {
  const fs::path whole = fs::absolute(output).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();  // "folder/" becomes "folder"
}

/// The name of the job. It depends on the output's path only, so that refuse_second_job finds an
/// earlier job for the same output by its name.
std::string job_name(const fs::path& output) {
  constexpr std::size_t kDigits = 12;  // of the hash: 48 bits, enough to distinguish outputs
  return "viscontact-" + sha256(absolute_output(output).string()).substr(0, kDigits);
}

/// Runs a program of Slurm and returns its output without the last newline. Throws
/// Error(kExternalProgram) if the program cannot be run or fails.
std::string ask_slurm(const std::vector<std::string>& command, const StopToken& stop) {
  auto result = run_process(command, {}, {}, {}, {}, stop);
  while (!result.output.empty() && result.output.back() == '\n') result.output.pop_back();
  std::string said;
  for (const char character : result.output)
    said += character == '\n' ? " | " : std::string(1, character);
  if (!result.started)
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("{} cannot be run ({}); submit where Slurm is installed (apt-get "
                            "install slurm-client), or tabulate here",
                            command.front(), said));
  if (result.exit_status != 0)
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("{} failed (exit status {}): {}; nothing was submitted",
                            command.front(), result.exit_status, said));
  return result.output;
}

/// Throws Error(kBadInput) if Slurm has a job for this output that is not over.
void refuse_second_job(const fs::path& output, const StopToken& stop) {
  std::string jobs = ask_slurm({"squeue", "--noheader", "--format=%F",
                                "--states=PENDING,RUNNING,SUSPENDED", "--name=" + job_name(output)},
                               stop);
  if (jobs.empty()) return;
  const std::string job = jobs.substr(0, jobs.find('\n'));
  throw_bad_input({output.string()},
                  fmt::format("is being tabulated by Slurm job {0}; wait until it "
                              "is over (squeue -j {0}), or end it (scancel {0})",
                              job));
}

/// The numbers of the tasks that have rows to compute.
std::vector<std::size_t> tasks_with_rows(const std::vector<CaseTable>& tables, std::size_t count) {
  std::vector<freefem_axi::RowRecord> records;
  records.reserve(tables.size());
  for (const auto& one : tables)
    records.push_back(freefem_axi::read_row_record(one.table, one.hash()));
  std::vector<std::size_t> tasks;
  for (std::size_t task = 0; task < count; ++task) {
    const auto points = points_of(tables, {task, count});
    for (std::size_t i = 0; i < tables.size(); ++i)
      if (!freefem_axi::missing_points(records[i], points[i]).empty()) {
        tasks.push_back(task);
        break;
      }
  }
  return tasks;
}

/// The numbers of the tasks as sbatch --array reads them, for example "0-3,7". Runs of numbers are
/// shortened, because sbatch limits the length of this text.
std::string array_of(const std::vector<std::size_t>& tasks) {
  std::string text;
  for (std::size_t first = 0, last = 0; first < tasks.size(); first = last + 1) {
    for (last = first; last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1;) ++last;
    text += (text.empty() ? "" : ",") + std::to_string(tasks[first]);
    if (last > first) text += fmt::format("-{}", tasks[last]);
  }
  return text;
}

/// The script of a task. It runs this program with the copies of the cases that were made when the
/// job was submitted.
std::string task_script(const std::vector<CaseTable>& tables, const SlurmRequest& request,
                        std::size_t count) {
  std::string command = shell_word(fs::read_symlink("/proc/self/exe").string()) + " tabulate";
  for (const auto& one : tables)
    command += " " + shell_word((slurm_folder(request.output) / one.c.path.filename()).string());
  return fmt::format(
      "#!/bin/sh\n# One task of the array; made by viscontact.\nexec {} -o {} --jobs {} --task "
      "\"$SLURM_ARRAY_TASK_ID/{}\"\n",
      command, shell_word(absolute_output(request.output).string()), request.jobs.value_or(1),
      count);
}

/// The names of the logs, in which sbatch replaces %A by the job's number and %a by the task's. A %
/// in the path of the folder is written as %%.
std::string log_pattern(const fs::path& folder) {
  std::string pattern;
  for (const char character : folder.string())
    pattern += character == '%' ? "%%" : std::string(1, character);
  return pattern + "/%A_%a.log";
}

/// The command, for the user, that puts the tables together after the job is over.
std::string gather_command(const std::vector<CaseTable>& tables, const fs::path& output) {
  std::string command = "viscontact tabulate";
  for (const auto& one : tables) command += " " + shell_word(one.c.path.string());
  return command + " -o " + shell_word(output.string()) + " --gather";
}

}  // namespace

fs::path slurm_folder(const fs::path& output) {
  return absolute_output(output).string() + ".slurm";
}

void submit_to_slurm(const std::vector<CaseTable>& tables, const SlurmRequest& request) {
  std::size_t rows = 0;
  for (const auto& one : tables) {
    check_output_file(one.table);
    rows += freefem_axi::grid_of(one.tabulation()).size();
  }
  const std::size_t count = request.tasks.value_or(std::min(rows, kMostTasks));
  const auto options = split_words(request.options);
  refuse_second_job(request.output, request.stop);
  const auto tasks = tasks_with_rows(tables, count);
  const std::string gather = gather_command(tables, request.output);
  if (tasks.empty()) {
    terminal::say(
        fmt::format("tabulate: no row is missing; this command writes the tables: {}", gather));
    return;
  }
  const auto folder = slurm_folder(request.output);
  for (const auto& one : tables) write_file(folder / one.c.path.filename(), one.c.text);
  const auto script = folder / "task.sh";
  write_file(script, task_script(tables, request, count));

  // With --requeue, the tasks of a node that fails are run again. The user's options come later on
  // the command line and can change this.
  std::vector<std::string> command = {"sbatch", "--requeue"};
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(), {"--parsable", "--job-name=" + job_name(request.output),
                                 "--array=" + array_of(tasks), "--open-mode=append",
                                 "--output=" + log_pattern(folder)});
  if (request.jobs) command.push_back(fmt::format("--cpus-per-task={}", *request.jobs));
  command.push_back(script.string());
  std::string job = ask_slurm(command, request.stop);
  // If there are several clusters, sbatch prints "number;cluster".
  job = job.substr(0, job.find(';'));
  terminal::say(
      fmt::format("tabulate: Slurm job {} with {} tasks is submitted; its logs are in {}; when it "
                  "is over (squeue -j {}), run:\n  {}",
                  job, tasks.size(), folder.string(), job, gather));
  fmt::print("{}\n", job);
}

}  // namespace viscontact::pipeline
