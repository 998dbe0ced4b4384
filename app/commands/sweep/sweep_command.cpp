// The command line of `sweep` (docs/command-line.md).
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/reduced_model/models/models.hpp"

namespace viscontact::app {
namespace {

void add_picture_options(CLI::App& command, SweepOptions& o) {
  add_value(command, "--plot", o.plot, kFile,
            "picture to write (SVG, PDF or PNG): lines over one key, or a map over two");
  add_value(command, "--x", o.x, "KEY",
            "key of the horizontal axis; default: the first varied key");
  add_value(command, "--y", o.y, "KEY", "key of the vertical axis, for a map");
  add_value(
      command, "--column", o.columns, "COLUMN,...",
      "what to draw, comma-separated: MODEL.minimal_gap, MODEL.film_ratio, ..., or COLUMN/KEY")
      ->delimiter(',');
}

void run_sweep(const SweepOptions& o) {
  check_array_options(o.array);
  check_models("--models", o.models);
  check_outputs(o.plot.empty() ? std::vector{o.output} : std::vector{o.output, o.plot});
  check_picture(o.plot);
  const auto kind = case_file::kind_of_case(o.case_file);
  if (kind == case_file::CaseKind::kParticles)
    sweep_many_particles(o);
  else if (kind == case_file::CaseKind::kSwimmer)
    sweep_swimmer(o);
  else
    sweep_sphere(o);
}

}  // namespace

std::vector<sweep::Variation> variations_of(const SweepOptions& o) {
  std::vector<sweep::Variation> variations;
  for (const auto& text : o.vary)
    variations.push_back(from_option("--vary", [&] { return sweep::parse_variation(text); }));
  return variations;
}

void add_sweep(CLI::App& app) {
  auto* command = app.add_subcommand(
      "sweep",
      "run a case many times with other values of its keys; each run gives a row of results");
  auto o = std::make_shared<SweepOptions>();
  add_value(*command, "CASE", o->case_file, kFile,
            "case file (TOML); its section [sweep] gives defaults for the options below")
      ->required();
  add_value(*command, "-o,--output", o->output, kFile,
            "rows to write (CSV); the same command continues an interrupted sweep")
      ->required();
  add_value(*command, "--vary", o->vary, "KEY=RANGE",
            "KEY=FROM:TO:log:COUNT, KEY=FROM:TO:COUNT or KEY=VALUE,VALUE,...; KEY as in the case: "
            "sphere.mass, motion.external_force[0].value; several --vary make a grid")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  add_value(*command, "--samples", o->samples, "N",
            "number of random points in the ranges, in place of the grid")
      ->check(CLI::Range(1.0, 1e12));
  command->add_option("--seed", o->seed, "seed of the random points")->capture_default_str();
  add_value(*command, "--models", o->models, kModels,
            "comma-separated; default: " + names_of(reduced_model::sweep_models(), ","))
      ->delimiter(',');
  add_value(*command, "--reference", o->reference, kModel,
            fmt::format("model that the others are compared with; default: {}, or the first",
                        reduced_model::usual_reference()));
  add_value(*command, "--fit", o->fit, kFile,
            "fit of the lubrication force (JSON); default: the case's [fit] file or exact; for a "
            "swimmer, its fit.json");
  add_picture_options(*command, *o);
  command
      ->add_option("--draws", o->draws,
                   "for a case of particles: number of random arrangements at each point")
      ->check(CLI::Range(1.0, 1e9));
  command->add_flag("--keep-runs", o->keep_runs,
                    "for a case of particles: keep all files of the runs, in OUTPUT.runs");
  o->jobs_option = add_jobs(*command, o->jobs,
                            "number of points computed at once; default in each Slurm task: 1");
  add_array_options(*command, o->array, "the table");
  auto* dry = command->add_flag("--dry-run", o->dry_run,
                                "print how many rows there are and about how long they take");
  add_json(*command, o->json)->needs(dry);
  for (auto* option : {o->array.launcher_option, o->array.gather_option, o->array.task_option})
    dry->excludes(option);
  command->callback([o] { run_sweep(*o); });
}

}  // namespace viscontact::app
