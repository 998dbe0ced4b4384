// Adds and checks the options of array jobs. A wrong option is an Error(kWrongUsage). A change must
// keep the names of the options, which submitted scripts contain.
#include "viscontact/app/commands/array_options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/interrupt.hpp"

namespace viscontact::app {

void add_array_options(CLI::App& command, ArrayOptions& o, const std::string& results) {
  o.launcher_option = add_value(command, "--launcher", o.launcher, "local|slurm",
                                "local: compute here; slurm: submit an array job")
                          ->check(one_of({"local", "slurm"}))
                          ->capture_default_str();
  command
      .add_option("--tasks", o.tasks,
                  "tasks of the array job; default: one for each row, at most 1000")
      ->check(CLI::Range(1, 4000000));  // Slurm allows no larger array (MaxArraySize)
  add_value(command, "--slurm-options", o.slurm_options, "OPTIONS",
            "more options for sbatch, in one argument");
  o.gather_option = command.add_flag(
      "--gather", o.gather,
      fmt::format("write {} from the rows of an array job, and compute no row", results));
  o.task_option = command.add_option(
      "--task", o.task,
      "K/T: compute only the rows K, K+T, ..., and write no table (as each task of the array job "
      "does)");
  o.gather_option->excludes(o.launcher_option);
  o.task_option->excludes(o.launcher_option)->excludes(o.gather_option);
}

void check_array_options(const ArrayOptions& o) {
  if (!o.is_slurm() && (o.tasks > 0 || !o.slurm_options.empty()))
    throw Error(ErrorKind::kWrongUsage, "--tasks and --slurm-options need --launcher slurm");
  (void)share_of(o);
}

pipeline::Share share_of(const ArrayOptions& o) {
  pipeline::Share share;
  if (o.task.empty()) return share;
  const char* const end = o.task.data() + o.task.size();
  const auto number = std::from_chars(o.task.data(), end, share.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, share.count);
    if (count.ec == std::errc() && count.ptr == end && share.number < share.count) return share;
  }
  throw Error(ErrorKind::kWrongUsage,
              fmt::format("--task is '{}'; it must be K/T with 0 <= K < T", o.task));
}

pipeline::ArrayRequest array_request(const ArrayOptions& o, const std::string& output,
                                     const CLI::Option& jobs_option, int jobs) {
  return {output, o.tasks > 0 ? std::optional(o.tasks) : std::nullopt,
          jobs_option.count() > 0 ? std::optional(jobs) : std::nullopt, o.slurm_options,
          interrupt_token()};
}

}  // namespace viscontact::app
