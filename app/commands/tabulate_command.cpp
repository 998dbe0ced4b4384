// Options of `tabulate`, and the choice between tabulating here, in shares, by Slurm, and
// gathering.
#include "viscontact/app/commands/tabulate_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/app/command_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/picture_stage.hpp"
#include "viscontact/pipeline/slurm.hpp"
#include "viscontact/pipeline/tabulate_stage.hpp"

namespace viscontact {

void add_tabulate(CLI::App& app) {
  struct Options {
    std::vector<std::string> case_files;
    std::string output, launcher = "local", slurm_options, task, plot;
    int jobs = default_jobs();
    std::size_t tasks = 0;
    bool gather = false, dry_run = false, json = false;
  };
  auto* command =
      app.add_subcommand("tabulate", "FreeFEM over the cases' grids of gaps and velocities");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_files, "case files (TOML)")->required()->type_name(kFile);
  command
      ->add_option("-o,--output", o->output,
                   "table to write (CSV); for several cases: folder, gets CASE.csv for each")
      ->required()
      ->type_name(kFile);
  const auto* jobs =
      add_jobs(*command, o->jobs, "FreeFEM processes at once; in each Slurm task: 1 unless given");
  auto* launcher =
      command
          ->add_option("--launcher", o->launcher, "local: compute here; slurm: submit an array job")
          ->type_name("local|slurm")
          ->check(one_of({"local", "slurm"}))
          ->capture_default_str();
  const auto* tasks =
      command
          ->add_option("--tasks", o->tasks,
                       "tasks of the array job; default: one for each row, at most 1000")
          ->check(CLI::Range(1, 4000000));
  const auto* slurm_options = command
                                  ->add_option("--slurm-options", o->slurm_options,
                                               "more options for sbatch, in one argument")
                                  ->type_name("OPTIONS");
  auto* gather = command->add_flag(
      "--gather", o->gather, "write the tables from the rows of an array job, computing none");
  auto* task = command->add_option("--task", o->task,
                                   "K/T: compute rows K, K+T, ... only, and write no table (what "
                                   "the array job's tasks do)");
  auto* plot =
      command
          ->add_option(
              "--plot", o->plot,
              "gaps of the case, comma-separated (none: the smallest, the middle and the largest): "
              "draws mesh and flow of their rows (SVG, VTK) in a folder beside the table")
          ->expected(0, 1)
          ->type_name("[GAP,GAP,...]");
  auto* dry = command->add_flag("--dry-run", o->dry_run,
                                "print how many rows there are and about how long they take");
  auto* json = add_json(*command, o->json);
  json->needs(dry);
  dry->excludes(launcher)->excludes(gather)->excludes(task)->excludes(plot);
  gather->excludes(launcher);
  plot->excludes(launcher);
  task->excludes(launcher)->excludes(gather)->excludes(plot);
  command->callback([o, jobs, tasks, slurm_options, plot] {
    const bool slurm = o->launcher == "slurm";
    if (!slurm && (tasks->count() > 0 || slurm_options->count() > 0))
      throw Error(ErrorKind::kWrongUsage, "--tasks and --slurm-options need --launcher slurm");
    check_outputs({o->output});
    const auto share = o->task.empty() ? Share() : parse_share(o->task);
    const auto tables = read_case_tables(o->case_files, o->output);
    for (const auto& one : tables) refuse_other_kind(one.table.string(), "# case: ", "table");
    // The gaps of the pictures of each table are checked before any work is done.
    std::vector<std::vector<double>> pictures;
    if (plot->count() > 0)
      for (const auto& one : tables) {
        pictures.push_back(gaps_to_picture(one.tabulation(), o->plot));
        check_pictures(pictures.back(), picture_folder(one.table));
      }
    if (o->dry_run) {
      std::vector<DryRun> runs;
      for (const auto& one : tables) runs.push_back(dry_run(one));
      fmt::print("{}", dry_run_text(runs, o->jobs, o->json));
      return;
    }
    if (slurm)
      submit_to_slurm(
          tables, {o->output, tasks->count() > 0 ? std::optional(o->tasks) : std::nullopt,
                   jobs->count() > 0 ? std::optional(o->jobs) : std::nullopt, o->slurm_options});
    else if (o->gather)
      gather_stage(tables, slurm_folder(o->output));
    else if (!o->task.empty())
      share_stage(tables, share, o->jobs);
    else
      tabulate_stage(tables, o->jobs);
    for (std::size_t i = 0; i < pictures.size(); ++i)
      picture_stage(tables[i].tabulation(), pictures[i], picture_folder(tables[i].table),
                    tables[i].c.path);
  });
}

}  // namespace viscontact
