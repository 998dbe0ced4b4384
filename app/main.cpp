// The program viscontact: reads the command line and calls the stages in pipeline/. Every Error is
// caught in main(), which prints its message and returns its exit code (results/exit_code.hpp).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include "viscontact/app/command_options.hpp"
#include "viscontact/app/commands/doctor.hpp"
#include "viscontact/app/commands/fit_command.hpp"
#include "viscontact/app/commands/init_command.hpp"
#include "viscontact/app/commands/particles_command.hpp"
#include "viscontact/app/commands/rerun.hpp"
#include "viscontact/app/commands/sweep_command.hpp"
#include "viscontact/app/commands/tabulate_command.hpp"
#include "viscontact/app/help/completion.hpp"
#include "viscontact/app/help/manual.hpp"
#include "viscontact/app/optional_values.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/locked_folder.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/system/interrupt.hpp"
#include "viscontact/pipeline/pipeline.hpp"
#include "viscontact/pipeline/simulate_stage.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/report.hpp"
#include "viscontact/results/exit_code.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/results/versions.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact {
namespace {

std::string version_text() {
  std::string text;
  for (const auto& [program, version] : library_versions())
    if (program != "Viscontact") text += fmt::format("{} {}\n", program, version);
  return fmt::format("viscontact {}\nFreeFEM {}\n{}", VISCONTACT_VERSION,
                     freefem_version_or_not_found(), text);
}

void add_shift(CLI::App& app) {
  struct Options {
    std::string table, fit, shift, plot;
  };
  auto* command = app.add_subcommand(
      "shift", "the depth at which a smooth wall drags like a rough one, from its table");
  auto o = std::make_shared<Options>();
  command->add_option("TABLE", o->table, "the rough wall's table (CSV)")
      ->required()
      ->type_name(kFile);
  command->add_option("--fit", o->fit, "fit of the smooth wall's force (JSON)")
      ->required()
      ->type_name(kFile);
  command->add_option("-o,--output", o->shift, "shifts to write, row by row (CSV)")
      ->required()
      ->type_name(kFile);
  command->add_option("--plot", o->plot, "picture to write (SVG)")->type_name(kFile);
  command->callback([o] {
    auto outputs = std::vector{o->shift};
    if (!o->plot.empty()) outputs.push_back(o->plot);
    check_outputs(outputs);
    refuse_other_kind(o->shift, "# viscontact: wall shift", "file of wall shifts");
    if (!o->plot.empty()) refuse_other_kind(o->plot, "<svg", "picture");
    shift_stage(o->table, o->fit, o->shift, o->plot);
  });
}

void add_simulate(CLI::App& app) {
  struct Options {
    std::string case_file, fit, folder;
    std::vector<std::string> models;
    std::string lubrication_limit;
    bool stokes_limit = false;
  };
  auto* command = app.add_subcommand("simulate", "one trajectory for each model of motion");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_file, "case file (TOML)")->required()->type_name(kFile);
  command
      ->add_option("--fit", o->fit,
                   "fit of the lubrication force (JSON); default: the case's [fit] file or exact "
                   "drag, else DIR/fit.json")
      ->type_name(kFile);
  command
      ->add_option("-o,--output", o->folder,
                   "folder; writes trajectories/MODEL.csv in it, and copies of case and fit")
      ->required()
      ->type_name(kFolder);
  command
      ->add_option("--models", o->models,
                   "comma-separated; default: those of the case, else " +
                       names_of(default_models()) +
                       "; on request: " + names_of(models_on_request()))
      ->type_name(kModels)
      ->delimiter(',');
  auto* limit = command
                    ->add_option("--lubrication-limit", o->lubrication_limit,
                                 "below the fit's smallest gap let the drag grow as k/q instead of "
                                 "stopping; k: fitted (default), or theory's; without this option "
                                 "as the case's [fit] below says")
                    ->check(one_of({"fitted", "theory"}))
                    ->expected(0, 1)
                    ->type_name("fitted|theory");
  command->add_flag("--stokes-limit", o->stokes_limit,
                    "above the fit's largest gap let the drag fall to Stokes' instead of stopping; "
                    "without this option as the case's [fit] above says");
  command->callback([o, limit] {
    check_outputs({o->folder});
    check_models("--models", o->models);
    const Case c = read_case(o->case_file);
    // Options that are not given are as in the case.
    const FitRequest request = c.fit.value_or(FitRequest{});
    OutsideFit outside{request.below, request.above};
    if (limit->count() > 0)
      outside.below = o->lubrication_limit == "theory" ? BelowInterval::kTheoryLimit
                                                       : BelowInterval::kLubricationLimit;
    if (o->stokes_limit) outside.above = AboveInterval::kStokesLimit;
    const LockedFolder ours(o->folder, kFolderIsHeld);
    simulate_stage(c, {o->fit, o->folder, o->models, outside});
  });
}

void add_compare(CLI::App& app) {
  struct Options {
    std::string folder, reference, output;
    std::vector<std::string> others;
    bool json = false;
  };
  auto* command = app.add_subcommand(
      "compare", "distances between trajectories, smallest gaps, times of contact");
  auto o = std::make_shared<Options>();
  command->add_option("DIR", o->folder, "folder of a run, or with trajectory files in it")
      ->required()
      ->type_name(kFolder);
  command
      ->add_option("TRAJECTORY", o->others,
                   "further trajectory files (CSV with columns time, gap, velocity)")
      ->type_name(kFile);
  command->add_option("--reference", o->reference, "model that the others are compared with")
      ->type_name(kModel)
      ->default_str("inertial");
  command
      ->add_option("-o,--output", o->output,
                   "comparison to write (JSON); default: DIR/comparison.json")
      ->type_name(kFile);
  add_json(*command, o->json);
  command->callback([o] {
    const std::filesystem::path output =
        o->output.empty() ? RunFolder{o->folder}.comparison() : std::filesystem::path(o->output);
    refuse_other_kind(output, "\"reference_model\"", "comparison");
    std::optional<LockedFolder> ours;
    if (o->output.empty() && std::filesystem::is_directory(o->folder))
      ours.emplace(o->folder, kFolderIsHeld);
    compare_stage(o->folder, {o->others.begin(), o->others.end()}, o->reference, output, {},
                  o->json);
  });
}

void add_report(CLI::App& app) {
  auto* command =
      app.add_subcommand("report", "report.html: one self-contained page with the plots");
  auto folder = std::make_shared<std::string>();
  command->add_option("DIR", *folder, "folder of a run")->required()->type_name(kFolder);
  command->callback([folder] {
    std::optional<LockedFolder> ours;
    if (std::filesystem::is_directory(*folder)) ours.emplace(*folder, kFolderIsHeld);
    write_report(*folder);
  });
}

void add_run(CLI::App& app) {
  struct Options {
    std::string case_file, folder;
    int jobs = default_jobs();
    bool json = false;
  };
  auto* command =
      app.add_subcommand("run", "the main job: tabulate, fit, simulate, compare, report");
  auto o = std::make_shared<Options>();
  command->add_option("CASE", o->case_file, "case file (TOML)")->required()->type_name(kFile);
  command
      ->add_option("-o,--output", o->folder,
                   "folder for the results; what is up to date there is not made again")
      ->required()
      ->type_name(kFolder);
  add_jobs(*command, o->jobs, "FreeFEM processes at once");
  add_json(*command, o->json);
  command->callback([o] {
    check_outputs({o->folder});
    const Case c = read_case(o->case_file);
    const LockedFolder ours(o->folder, kFolderIsHeld);
    run_stages(c, o->folder, o->jobs, o->json);
  });
}

/// Adds the commands `completion` and `man`, whose texts are made from the command line itself.
void add_self_description(CLI::App& app) {
  auto* completion = app.add_subcommand(
      "completion", "completion for a shell: source <(viscontact completion bash)");
  auto shell = std::make_shared<std::string>();
  completion->add_option("SHELL", *shell, "for which shell")
      ->required()
      ->type_name("bash|zsh")
      ->check(one_of({"bash", "zsh"}));
  completion->callback([&app, shell] {
    fmt::print("{}", *shell == "zsh" ? zsh_completion(app) : bash_completion(app));
  });
  app.add_subcommand("man", "the manual page: viscontact man | man -l -")->callback([&app] {
    fmt::print("{}", manual(app, VISCONTACT_VERSION));
  });
}

void add_doctor(CLI::App& app, bool& healthy) {
  auto* command = app.add_subcommand("doctor", "what is installed, and how to mend what is not");
  auto json = std::make_shared<bool>(false);
  add_json(*command, *json);
  command->callback([&healthy, json] { healthy = examine(*json); });
}

int run(int argc, char** argv) {
  CLI::App app("Lubrication force of a sphere near contact: tabulate, fit, simulate, compare.",
               "viscontact");
  app.require_subcommand(1);
  app.set_version_flag("--version", version_text,
                       "versions of Viscontact and of what it is built with");
  bool healthy = true;
  app.footer(help_footer());
  add_init(app);
  add_run(app);
  add_tabulate(app);
  add_fit(app);
  add_export(app);
  add_shift(app);
  add_simulate(app);
  add_sweep(app);
  add_particles(app);
  add_compare(app);
  add_report(app);
  add_rerun(app);
  add_doctor(app, healthy);
  add_self_description(app);
  if (argc > 1 && argv[1][0] != '-') {
    std::string names;
    bool known = false;
    for (const auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
      names += (names.empty() ? "" : ", ") + command->get_name();
      known = known || command->get_name() == argv[1];
    }
    if (!known)
      throw Error(ErrorKind::kWrongUsage,
                  fmt::format("there is no subcommand '{}'; there are: {}", argv[1], names));
  }
  try {
    auto arguments = with_files_apart({argv + std::min(argc, 1), argv + argc});
    std::ranges::reverse(arguments);  // CLI11 takes the arguments in reverse order
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);  // --help, --version
    complain(fmt::format("viscontact: {}; see viscontact --help", error.what()));
    return exit_code_of(ErrorKind::kWrongUsage);
  }
  return healthy ? 0 : exit_code_of(ErrorKind::kExternalProgram);
}

}  // namespace
}  // namespace viscontact

int main(int argc, char** argv) {
  using viscontact::ErrorKind;
  using viscontact::exit_code_of;
  viscontact::catch_interrupts();
  try {
    const int exit_code = viscontact::run(argc, argv);
    if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      viscontact::throw_bad_input({"standard output"}, "cannot be written");
    return exit_code;
  } catch (const viscontact::Error& error) {
    viscontact::clear_progress();
    const bool wrong_usage = error.kind() == ErrorKind::kWrongUsage;
    viscontact::complain(fmt::format("viscontact: {}{}", error.what(),
                                     wrong_usage ? "; see viscontact --help" : ""));
    return exit_code_of(error.kind());
  } catch (const std::bad_alloc&) {
    viscontact::complain("viscontact: there is not enough memory for this");
    return exit_code_of(ErrorKind::kNotConverged);
  } catch (const std::exception& error) {
    // An error of the file system or of a library that no check has found before.
    viscontact::complain(fmt::format("viscontact: {}", error.what()));
    return exit_code_of(ErrorKind::kBadInput);
  }
}
