// The command line of `tabulate` (docs/command-line.md), and the choice of what to do: compute all
// rows here, compute the rows of one task, submit a job to Slurm, or gather the rows of such a job.
// pipeline/tabulate/ does the work.
#include <fmt/format.h>

#include <charconv>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/tabulate/picture_stage.hpp"
#include "viscontact/pipeline/tabulate/slurm.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"

namespace viscontact::app {

namespace {

struct TabulateOptions {
  std::vector<std::string> case_files;
  std::string output, launcher = "local", slurm_options, task, plot;
  int jobs = default_jobs();
  std::size_t tasks = 0;
  bool gather = false, dry_run = false, json = false;
  /// CLI11's objects of --jobs and --plot, which tell whether an option was given.
  const CLI::Option *jobs_option = nullptr, *plot_option = nullptr;
};

/// Reads the K/T of --task. Throws Error(kWrongUsage) unless these are integers with 0 <= K < T.
pipeline::Share read_share(const std::string& text) {
  pipeline::Share share;
  const char* const end = text.data() + text.size();
  const auto number = std::from_chars(text.data(), end, share.number);
  if (number.ec == std::errc() && number.ptr != end && *number.ptr == '/') {
    const auto count = std::from_chars(number.ptr + 1, end, share.count);
    if (count.ec == std::errc() && count.ptr == end && share.number < share.count) return share;
  }
  throw Error(ErrorKind::kWrongUsage,
              fmt::format("--task is '{}'; it must be K/T with 0 <= K < T", text));
}

/// Reads the gaps of --plot. Throws Error(kWrongUsage) for a word that is not a number.
std::vector<double> read_gaps(const std::string& text) {
  std::vector<double> gaps;
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto gap = parse_number(word);
    if (!gap)
      throw Error(
          ErrorKind::kWrongUsage,
          fmt::format("--plot: '{}' is not a number; give gaps of the case, separated by commas",
                      word));
    gaps.push_back(*gap);
  }
  return gaps;
}

/// Calls `call`. The message of an Error for missing rows or of Slurm is followed by `remedy`,
/// which names the options that help.
template <class Call>
void with_remedy(std::string_view remedy, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotConverged && error.kind() != ErrorKind::kExternalProgram)
      throw;
    throw Error(error.kind(), fmt::format("{}; {}", error.what(), remedy));
  }
}

void tabulate_cases(const TabulateOptions& o) {
  const bool slurm = o.launcher == "slurm";
  if (!slurm && (o.tasks > 0 || !o.slurm_options.empty()))
    throw Error(ErrorKind::kWrongUsage, "--tasks and --slurm-options need --launcher slurm");
  check_outputs({o.output});
  const auto share = o.task.empty() ? pipeline::Share() : read_share(o.task);
  const auto gaps = read_gaps(o.plot);
  const auto tables = pipeline::read_case_tables(o.case_files, o.output);
  for (const auto& one : tables)
    results::refuse_other_kind(one.table.string(), "# case: ", "table");
  // The gaps of the pictures of each table are checked before any work is done.
  std::vector<std::vector<double>> pictures;
  if (o.plot_option->count() > 0)
    for (const auto& one : tables) {
      pictures.push_back(
          with_place("--plot", [&] { return pipeline::gaps_to_picture(one.tabulation(), gaps); }));
      pipeline::check_pictures(pictures.back(), pipeline::picture_folder(one.table));
    }
  if (o.dry_run) {
    std::vector<pipeline::DryRun> runs;
    for (const auto& one : tables) runs.push_back(pipeline::dry_run(one));
    fmt::print("{}", pipeline::dry_run_text(runs, o.jobs, o.json));
    return;
  }
  if (slurm)
    with_remedy("see --slurm-options, --tasks, or leave out --launcher slurm", [&] {
      pipeline::submit_to_slurm(tables,
                                {o.output, o.tasks > 0 ? std::optional(o.tasks) : std::nullopt,
                                 o.jobs_option->count() > 0 ? std::optional(o.jobs) : std::nullopt,
                                 o.slurm_options, interrupt_token()});
    });
  else if (o.gather)
    with_remedy(
        "the same command without --gather computes the missing rows here, or with --launcher "
        "slurm or --task elsewhere",
        [&] {
          pipeline::gather_stage(tables, pipeline::slurm_folder(o.output), interrupt_token());
        });
  else if (!o.task.empty())
    pipeline::share_stage(tables, share, o.jobs, interrupt_token());
  else
    pipeline::tabulate_stage(tables, o.jobs, interrupt_token());
  for (std::size_t i = 0; i < pictures.size(); ++i)
    pipeline::picture_stage(tables[i].tabulation(), pictures[i],
                            pipeline::picture_folder(tables[i].table), tables[i].c.path,
                            interrupt_token());
}

}  // namespace

void add_tabulate(CLI::App& app) {
  auto* command = app.add_subcommand(
      "tabulate", "compute forces with FreeFEM on the grid of gaps and velocities of each case");
  auto o = std::make_shared<TabulateOptions>();
  add_value(*command, "CASE", o->case_files, kFile, "case files (TOML)")->required();
  add_value(*command, "-o,--output", o->output, kFile,
            "table to write (CSV); for several cases, a folder in which each gets CASE.csv")
      ->required();
  o->jobs_option = add_jobs(*command, o->jobs,
                            "number of FreeFEM processes at once; default in each Slurm task: 1");
  auto* launcher = add_value(*command, "--launcher", o->launcher, "local|slurm",
                             "local: compute here; slurm: submit an array job")
                       ->check(one_of({"local", "slurm"}))
                       ->capture_default_str();
  command
      ->add_option("--tasks", o->tasks,
                   "tasks of the array job; default: one for each row, at most 1000")
      ->check(CLI::Range(1, 4000000));
  add_value(*command, "--slurm-options", o->slurm_options, "OPTIONS",
            "more options for sbatch, in one argument");
  auto* gather = command->add_flag(
      "--gather", o->gather, "write the tables from the rows of an array job, and compute no row");
  auto* task = command->add_option("--task", o->task,
                                   "K/T: compute only the rows K, K+T, ..., and write no table (as "
                                   "each task of the array job does)");
  auto* plot =
      add_value(
          *command, "--plot", o->plot, "[GAP,GAP,...]",
          "gaps of the case, comma-separated (none: the smallest, the middle and the largest): "
          "draws mesh and flow of their rows (SVG, VTK) in a folder beside the table")
          ->expected(0, 1);
  auto* dry = command->add_flag("--dry-run", o->dry_run,
                                "print how many rows there are and about how long they take");
  auto* json = add_json(*command, o->json);
  json->needs(dry);
  dry->excludes(launcher)->excludes(gather)->excludes(task)->excludes(plot);
  gather->excludes(launcher);
  plot->excludes(launcher);
  o->plot_option = plot;
  task->excludes(launcher)->excludes(gather)->excludes(plot);
  command->callback([o] { tabulate_cases(*o); });
}

}  // namespace viscontact::app
