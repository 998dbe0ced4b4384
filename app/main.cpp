// viscontact: the command line. Arguments are read here, the work is done in pipeline.cpp, every
// Error ends up at the bottom.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <optional>
#include <thread>

#include "app/doctor.hpp"
#include "app/pipeline.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_folder.hpp"
#include "app/slurm.hpp"
#include "app/tabulate_stage.hpp"
#include "app/versions.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/named.hpp"
#include "fitting/terms.hpp"
#include "reduced_model/models.hpp"

namespace viscontact {
namespace {

/// An output that is there already is replaced only if it is of the same kind: its text has the marker. Throws Error(kBadInput) otherwise.
void refuse_other_kind(const std::string& path, std::string_view marker, std::string_view kind) {
  if (!std::filesystem::is_regular_file(path))
    return;  // nothing there, or write_file's own refusals
  const std::string text = read_file(path);
  if (!text.empty() && text.find(marker) == std::string::npos)
    throw_bad_input(
        {path}, fmt::format("is there and is no {}; remove it first, or write elsewhere", kind));
}

std::string version_text() {
  std::string text;
  for (const auto& [program, version] : library_versions())
    if (program != "Viscontact") text += fmt::format("{} {}\n", program, version);
  return fmt::format("viscontact {}\nFreeFEM {}\n{}", VISCONTACT_VERSION,
                     freefem_version_or_not_found(), text);
}

int default_jobs() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

void add_tabulate(CLI::App& app) {
  struct Options {
    std::vector<std::string> case_files;
    std::string output, launcher = "local", slurm_options, task;
    int jobs = default_jobs();
    std::size_t tasks = 0;
    bool gather = false;
  };
  auto* command =
      app.add_subcommand("tabulate", "FreeFEM over the cases' grids of gaps and velocities");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_files, "case files (TOML)")->required();
  command
      ->add_option("-o,--output", o->output,
                   "table to write (CSV); for several cases: folder, gets CASE.csv for each")
      ->required();
  const auto* jobs = command
                         ->add_option("-j,--jobs", o->jobs,
                                      "FreeFEM processes at once; in each Slurm task: 1 unless "
                                      "given")
                         ->check(CLI::Range(1, 1024))
                         ->capture_default_str();
  auto* launcher =
      command
          ->add_option("--launcher", o->launcher, "local: compute here; slurm: submit an array job")
          ->check(CLI::IsMember({"local", "slurm"}))
          ->capture_default_str();
  const auto* tasks =
      command
          ->add_option("--tasks", o->tasks,
                       "tasks of the array job; default: one for each row, at most 1000")
          ->check(CLI::Range(1, 4000000));
  const auto* slurm_options = command->add_option("--slurm-options", o->slurm_options,
                                                  "more options for sbatch, in one argument");
  auto* gather = command->add_flag(
      "--gather", o->gather, "write the tables from the rows of an array job, computing none");
  auto* task = command->add_option("--task", o->task,
                                   "K/T: compute rows K, K+T, ... only, and write no table (what "
                                   "the array job's tasks do)");
  gather->excludes(launcher);
  task->excludes(launcher)->excludes(gather);
  command->callback([o, jobs, tasks, slurm_options] {
    const bool slurm = o->launcher == "slurm";
    if (!slurm && (tasks->count() > 0 || slurm_options->count() > 0))
      throw Error(ExitCode::kWrongUsage,
                  "--tasks and --slurm-options are for --launcher slurm only");
    const auto share = o->task.empty() ? Share() : parse_share(o->task);
    const auto tables = read_case_tables(o->case_files, o->output);
    for (const auto& one : tables)
      refuse_other_kind(one.table.string(), "# viscontact: force table", "table");
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
  });
}

void add_fit(CLI::App& app) {
  struct Options {
    std::string table, fit, basis = "lecture", weights = "relative";
  };
  auto* command = app.add_subcommand("fit", "least squares of a table");
  auto o = std::make_shared<Options>();
  command->add_option("TABLE", o->table, "table of forces (CSV)")->required();
  command->add_option("-o,--output", o->fit, "fit to write (JSON)")->required();
  command->add_option("--basis", o->basis, "one of: " + names_of(all_bases()))
      ->capture_default_str();
  command->add_option("--weights", o->weights, "residuals: relative to the force, or absolute")
      ->capture_default_str();
  command->callback([o] {
    refuse_other_kind(o->fit, "\"gap_interval\"", "fit");
    fit_stage(o->table, o->fit, o->basis, parse_weights(o->weights));
  });
}

void add_simulate(CLI::App& app) {
  struct Options {
    std::string case_file, fit, folder;
    std::vector<std::string> models;
    bool lubrication_limit = false;
  };
  auto* command = app.add_subcommand("simulate", "one trajectory for each model of motion");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_file, "case file (TOML)")->required();
  command->add_option("--fit", o->fit, "fit of the lubrication force (JSON)")->required();
  command
      ->add_option("-o,--output", o->folder,
                   "folder; writes trajectories/MODEL.csv in it, and copies of case and fit")
      ->required();
  command
      ->add_option("--models", o->models,
                   "comma-separated; default: the case's, or all of: " + names_of(all_models()))
      ->delimiter(',');
  command->add_flag("--lubrication-limit", o->lubrication_limit,
                    "below the fit's smallest gap use the leading term and what the fit adds to it "
                    "there, instead of stopping");
  command->callback([o] {
    simulate_stage(read_case(o->case_file), o->fit, o->folder, o->models,
                   o->lubrication_limit ? BelowInterval::kLubricationLimit : BelowInterval::kError);
  });
}

void add_compare(CLI::App& app) {
  struct Options {
    std::string folder, reference = "inertial", output;
    std::vector<std::string> others;
  };
  auto* command = app.add_subcommand(
      "compare", "distances between trajectories, smallest gaps, times of contact");
  auto o = std::make_shared<Options>();
  command->add_option("DIR", o->folder, "folder of a run, or with trajectory files in it")
      ->required();
  command->add_option("TRAJECTORY", o->others,
                      "further trajectory files (CSV with columns time, gap, velocity)");
  command->add_option("--reference", o->reference, "model that the others are compared with")
      ->capture_default_str();
  command->add_option("-o,--output", o->output,
                      "comparison to write (JSON); default: DIR/comparison.json");
  command->callback([o] {
    const std::filesystem::path output =
        o->output.empty() ? RunFolder{o->folder}.comparison() : std::filesystem::path(o->output);
    refuse_other_kind(output.string(), "\"reference_model\"", "comparison");
    compare_stage(o->folder, {o->others.begin(), o->others.end()}, o->reference, output);
  });
}

void add_report(CLI::App& app) {
  auto* command =
      app.add_subcommand("report", "report.html: one self-contained page with the plots");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder of a run")->required();
  command->callback([folder] { write_report(*folder); });
}

void add_run(CLI::App& app) {
  struct Options {
    std::string case_file, folder;
    int jobs = default_jobs();
  };
  auto* command =
      app.add_subcommand("run", "the main job: tabulate, fit, simulate, compare, report");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_file, "case file (TOML)")->required();
  command
      ->add_option("-o,--output", o->folder,
                   "folder for the results; what is up to date there is not made again")
      ->required();
  command->add_option("-j,--jobs", o->jobs, "FreeFEM processes at once")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->callback([o] { run_stages(read_case(o->case_file), o->folder, o->jobs); });
}

void add_doctor(CLI::App& app, bool& healthy) {
  app.add_subcommand("doctor", "what is installed, and how to mend what is not")
      ->callback([&healthy] { healthy = examine(); });
}

int run(int argc, char** argv) {
  CLI::App app("Lubrication force of a sphere near contact: tabulate, fit, simulate, compare.",
               "viscontact");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text,
                       "versions of Viscontact and of what it is built with");
  bool healthy = true;
  add_run(app);
  add_tabulate(app);
  add_fit(app);
  add_simulate(app);
  add_compare(app);
  add_report(app);
  add_doctor(app, healthy);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    say(fmt::format("viscontact: {}; see viscontact --help", error.what()));
    return static_cast<int>(ExitCode::kWrongUsage);
  }
  return static_cast<int>(healthy ? ExitCode::kDone : ExitCode::kExternalProgram);
}

}  // namespace
}  // namespace viscontact

int main(int argc, char** argv) {
  using viscontact::ExitCode;
  viscontact::catch_interrupts();
  try {
    const int exit_code = viscontact::run(argc, argv);
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      viscontact::throw_bad_input({"standard output"}, "cannot be written");
    return exit_code;
  } catch (const viscontact::Error& error) {
    viscontact::clear_progress();
    const bool wrong_usage = error.exit_code() == ExitCode::kWrongUsage;
    viscontact::say(fmt::format("viscontact: {}{}", error.what(),
                                wrong_usage ? "; see viscontact --help" : ""));
    return static_cast<int>(error.exit_code());
  } catch (const std::bad_alloc&) {
    viscontact::say("viscontact: there is not enough memory for this");
    return static_cast<int>(ExitCode::kNotConverged);
  } catch (const std::exception& error) {
    // The file system or a library, in a way that no check foresaw.
    viscontact::say(fmt::format("viscontact: {}", error.what()));
    return static_cast<int>(ExitCode::kBadInput);
  }
}
