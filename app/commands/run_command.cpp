// `run` (all results of one case) and its last stages, `simulate`, `compare` and `report`. A
// command locks the folder into which it writes, because two at once would mix their files.
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/app/arguments/command_options.hpp"
#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/particle_runs/run/particles_pages.hpp"
#include "viscontact/pipeline/compare_stage.hpp"
#include "viscontact/pipeline/run_stages.hpp"
#include "viscontact/pipeline/simulate/simulate_stage.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/report.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/rolling/job/rolling_stage.hpp"
#include "viscontact/swimmer/job/swimmer_stage.hpp"

namespace viscontact::app {

void add_run(CLI::App& app) {
  struct Options {
    std::string case_file, folder, plots;
    int jobs = default_jobs();
    bool json = false;
  };
  auto* command =
      app.add_subcommand("run", "run the main job: tabulate, fit, simulate, compare, report");
  auto o = std::make_shared<Options>();
  add_value(*command, "CASE", o->case_file, kFile, "case file (TOML)")->required();
  add_value(*command, "-o,--output", o->folder, kFolder,
            "folder for the results; files in it that are up to date are not made again")
      ->required();
  add_jobs(*command, o->jobs, "number of FreeFEM processes at once");
  add_plots(*command, o->plots);
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    check_plots(o->plots);
    const case_file::Case c = case_file::read_case(o->case_file);
    {
      const LockedFolder lock(o->folder, results::kFolderIsLocked);
      pipeline::run_stages(c, o->folder, o->jobs, o->json, interrupt_token());
    }
    make_plots(o->plots, o->folder);
  });
}

void add_simulate(CLI::App& app) {
  struct Options {
    std::string case_file, fit, folder;
    std::vector<std::string> models;
    std::string lubrication_limit;
    bool stokes_limit = false;
  };
  auto* command = app.add_subcommand("simulate", "compute one trajectory for each model of motion");
  auto o = std::make_shared<Options>();
  add_value(*command, "CASE", o->case_file, kFile, "case file (TOML)")->required();
  add_value(*command, "--fit", o->fit, kFile,
            "fit of the lubrication force (JSON); default: the case's [fit] file or exact drag, "
            "else DIR/fit.json");
  add_value(*command, "-o,--output", o->folder, kFolder,
            "folder; writes trajectories/MODEL.csv in it, and copies of case and fit")
      ->required();
  add_value(*command, "--models", o->models, kModels,
            "comma-separated; default: those of the case, else " +
                names_of(reduced_model::default_models()) +
                "; on request: " + names_of(reduced_model::models_on_request()))
      ->delimiter(',');
  auto* limit = add_value(*command, "--lubrication-limit", o->lubrication_limit, "fitted|theory",
                          "below the fit's smallest gap, let the drag grow as k/q instead of "
                          "ending with an error; k is the fitted value (default) or that of "
                          "theory; default: the key 'below' in the case's section [fit]")
                    ->check(one_of({"fitted", "theory"}))
                    ->expected(0, 1);
  command->add_flag("--stokes-limit", o->stokes_limit,
                    "above the fit's largest gap, let the drag fall to Stokes' drag instead of "
                    "ending with an error; default: the key 'above' in the case's section [fit]");
  command->callback([o, limit] {
    check_outputs({o->folder});
    check_models("--models", o->models);
    const case_file::Case c = case_file::read_case(o->case_file);
    auto outside = c.fit.value_or(case_file::FitRequest{}).outside;
    if (limit->count() > 0)
      outside.below = o->lubrication_limit == "theory"
                          ? lubrication::BelowInterval::kTheoryLimit
                          : lubrication::BelowInterval::kLubricationLimit;
    if (o->stokes_limit) outside.above = lubrication::AboveInterval::kStokesLimit;
    const LockedFolder lock(o->folder, results::kFolderIsLocked);
    pipeline::simulate_stage(
        c, {o->fit, o->folder, o->models, outside, interrupt_token(), "give a fit with --fit"});
  });
}

void add_compare(CLI::App& app) {
  struct Options {
    std::string folder, reference, output;
    std::vector<std::string> others;
    bool json = false;
  };
  auto* command = app.add_subcommand(
      "compare", "compare trajectories: distances, smallest gaps, times of contact");
  auto o = std::make_shared<Options>();
  add_value(*command, "DIR", o->folder, kFolder, "folder of a run, or with trajectory files in it")
      ->required();
  add_value(*command, "TRAJECTORY", o->others, kFile,
            "further trajectory files (CSV with columns time, gap, velocity)");
  add_value(*command, "--reference", o->reference, kModel,
            "model that the others are compared with")
      ->default_str(reduced_model::usual_reference());
  add_value(*command, "-o,--output", o->output, kFile,
            "comparison to write (JSON); default: DIR/comparison.json");
  add_json(*command, o->json);
  command->callback([o] {
    const std::filesystem::path output = o->output.empty()
                                             ? results::RunFolder{o->folder}.comparison()
                                             : std::filesystem::path(o->output);
    results::refuse_other_kind(output, "\"reference_model\"", "comparison");
    std::optional<LockedFolder> lock;
    if (o->output.empty() && std::filesystem::is_directory(o->folder))
      lock.emplace(o->folder, results::kFolderIsLocked);
    pipeline::compare_stage(o->folder, {o->others.begin(), o->others.end()}, o->reference, output,
                            {}, o->json, interrupt_token());
  });
}

namespace {

/// The command that made the folder (run, rolling, swimmer or particles) is recognised by the names
/// of its files. Throws Error(kBadInput) if there is none of these files.
void report_again(const std::filesystem::path& folder) {
  const auto has = [&](const char* name) {
    return std::filesystem::is_regular_file(folder / name);
  };
  if (has("rolling.json"))
    rolling::report_rolling(folder, interrupt_token());
  else if (has("swimmer.json"))
    swimmer::report_swimmer(folder, interrupt_token());
  else if (has("particles.pvd"))
    particles::report_particles(folder);
  else if (std::filesystem::is_directory(folder / "trajectories"))
    report::write_report(folder, {}, interrupt_token());
  else
    throw_bad_input({folder.string()},
                    "is not the folder of a run: it has none of trajectories/, rolling.json, "
                    "swimmer.json and particles.pvd");
}

}  // namespace

void add_report(CLI::App& app) {
  auto* command = app.add_subcommand(
      "report", "make the page and the pictures of a folder again from its other files");
  auto folder = std::make_shared<std::string>();
  auto plots = std::make_shared<std::string>();
  add_value(*command, "DIR", *folder, kFolder,
            "folder that run, rolling, swimmer or particles wrote")
      ->required();
  add_plots(*command, *plots);
  command->callback([folder, plots] {
    check_plots(*plots);
    {
      std::optional<LockedFolder> lock;
      if (std::filesystem::is_directory(*folder)) lock.emplace(*folder, results::kFolderIsLocked);
      report_again(*folder);
    }
    make_plots(*plots, *folder);
  });
}

}  // namespace viscontact::app
