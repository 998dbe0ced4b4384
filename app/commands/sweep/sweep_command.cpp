// `sweep`: its options, and what its picture shows.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/commands.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/sweep_stage.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/pictures/sweep_plot.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/rolling/rolling_motion.hpp"

namespace viscontact::app {
namespace {

/// Adds the options that set the picture in `o`, which must outlive `command`.
void add_picture_options(CLI::App& command, SweepOptions& o) {
  add_picture(command, o.plot,
              "picture to write (SVG, PDF, PNG or gnuplot's script, .gp): lines over one key, or a "
              "map over two");
  add_value(command, "--x", o.x, "KEY",
            "key of the horizontal axis; default: the first varied key");
  add_value(command, "--y", o.y, "KEY", "key of the vertical axis, for a map");
  add_value(
      command, "--column", o.columns, "COLUMN,...",
      "what to draw, comma-separated: MODEL.minimal_gap, MODEL.film_ratio, ..., or COLUMN/KEY")
      ->delimiter(',');
}

/// What to draw: axes (without y lines over x, otherwise a map in colours), columns, and the keys
/// of which each value has a line of its own. An option of the command line decides first, then the
/// section [sweep] of the case, provided that the sweep has the keys and columns that the section
/// names. Otherwise the first varied keys are the axes, and the columns are s.columns. Throws
/// Error(kWrongUsage) if no key is varied, or if a map of random samples was asked for.
report::SweepPlot picture_of(const SweepOptions& o, const CaseStudy& s) {
  const auto& request = s.request;
  const auto& points = s.study.points;
  if (points.variations.empty())
    throw Error(ErrorKind::kWrongUsage,
                "a picture needs a varied key for its horizontal axis; give --vary");
  const auto columns = s.study.columns();
  const auto is_there = [&](const std::string& column) {
    const auto slash = column.find('/');
    return std::ranges::find(columns, column.substr(0, slash)) != columns.end() &&
           (slash == std::string::npos || points.is_varied(column.substr(slash + 1)));
  };
  report::SweepPlot picture{o.x, o.y, o.columns, {}, points.draws > 0};
  if (picture.x.empty() && picture.y.empty()) {
    if (points.is_varied(request.x)) picture.x = request.x;
    if (points.is_varied(request.y) && points.samples == 0) picture.y = request.y;
  }
  if (picture.columns.empty() && std::ranges::all_of(request.plot, is_there))
    picture.columns = request.plot;
  if (picture.x.empty()) {
    const auto free = std::ranges::find_if(points.variations, [&](const sweep::Variation& v) {
      return v.key != picture.y && v.count > 1;
    });
    picture.x = free != points.variations.end() ? free->key : points.variations[0].key;
    const auto other = std::ranges::find_if(points.variations, [&](const sweep::Variation& v) {
      return v.key != picture.x && v.count > 1;
    });
    if (picture.y.empty() && points.samples == 0 && other != points.variations.end())
      picture.y = other->key;
  }
  if (!picture.y.empty() && points.samples > 0)
    throw Error(ErrorKind::kWrongUsage,
                "a map can be drawn of a grid only, not of random samples; leave out --y");
  if (picture.columns.empty()) picture.columns = s.columns;
  if (points.samples == 0)
    for (const auto& v : points.variations)
      if (v.count > 1 && v.key != picture.x) picture.others.push_back(v.key);
  return picture;
}

/// Throws Error(kWrongUsage) if the sweep does not have the axes and columns of the picture, or if
/// the picture would have more than 14 lines.
void check_columns(const report::SweepPlot& picture, const sweep::Study& study) {
  const auto columns = study.columns();
  const auto& points = study.points;
  const auto check = [&](const std::string& name) {
    if (std::ranges::find(columns, name) != columns.end()) return;
    throw Error(ErrorKind::kWrongUsage, "there is no column '{}' to plot; the columns are: {}",
                name, fmt::join(columns, ", "));
  };
  for (const auto& axis : {picture.x, picture.y}) {
    if (axis.empty()) continue;
    const auto key = std::ranges::find(points.variations, axis, &sweep::Variation::key);
    if (key == points.variations.end() || (key->count < 2 && points.samples == 0))
      throw Error(ErrorKind::kWrongUsage,
                  "'{}' cannot be an axis of the plot; an axis must be a key that is varied over "
                  "at least two values",
                  axis);
  }
  auto lines = static_cast<double>(picture.columns.size());
  for (const auto& v : points.variations)
    if (std::ranges::count(picture.others, v.key) > 0) lines *= static_cast<double>(v.count);
  constexpr double kMostLines = 14;  // each of the 7 colours twice
  if (picture.y.empty() && lines > kMostLines)
    throw Error(ErrorKind::kWrongUsage,
                "the plot would have {} lines over {}; at most {} are allowed, so draw a map with "
                "--y, or fewer columns",
                lines, picture.x, kMostLines);
  for (const auto& column : picture.columns) {
    const auto slash = column.find('/');
    check(column.substr(0, slash));
    if (slash != std::string::npos) check(column.substr(slash + 1));
  }
}

/// The picture that --plot asks for, if any. Called before rows are computed, because it throws the
/// errors of picture_of() and check_columns().
std::optional<report::SweepPlot> checked_picture(const SweepOptions& o, const CaseStudy& s) {
  if (o.plot.path.empty()) return {};
  auto picture = picture_of(o, s);
  check_columns(picture, s.study);
  return picture;
}

/// Draws `picture` into the file of --plot, from the CSV `file`, which contains the rows of the
/// sweep, or their means over random arrangements of particles.
void draw(const SweepOptions& o, const CaseStudy& s, const report::SweepPlot& picture,
          const std::filesystem::path& file) {
  const auto format = o.plot.format();
  results::write_output(o.plot.path, format.kind,
                        report::plot_sweep(file, picture, format, interrupt_token()),
                        results::provenance_of(results::Inputs{s.files, {file}}));
}

void run_particles_sweep(const SweepOptions& o) {
  const auto sweep = sweep_of_particles(o);
  const auto s = study_of_particles(sweep);
  const auto picture = checked_picture(o, s);
  sweep_many_particles(o, sweep);
  if (picture && !o.dry_run)
    draw(o, s, *picture,
         picture->is_of_means ? particles::path_of_means(o.output)
                              : std::filesystem::path(o.output));
}

/// Computes the rows of a study, and then draws the picture. Throws Error(kNotConverged) if all
/// rows failed. With --dry-run only the time that the rows would take is printed.
void run_study(const SweepOptions& o, const CaseStudy& s) {
  const auto picture = checked_picture(o, s);
  if (o.dry_run) {
    fmt::print("{}",
               pipeline::dry_run_text({pipeline::dry_run(s.study, o.output, interrupt_token())},
                                      o.jobs, o.json));
    return;
  }
  pipeline::run_sweep(s.study, {o.output, o.jobs, interrupt_token()}, {s.files, {}}, s.part);
  if (picture) draw(o, s, *picture, o.output);
}

void run_sweep(const SweepOptions& o) {
  check_array_options(o.array);
  // A name that is no model of any kind of case is refused before the case is read.
  for (const auto& model : o.models)
    if (!reduced_model::known_model(model) &&
        find_named(rolling::rolling_models(), model) == nullptr)
      throw Error(ErrorKind::kWrongUsage,
                  "--models: no model is named '{}'; there are: {}; for a rolling sphere: {}",
                  model, names_of(reduced_model::all_models()),
                  names_of(rolling::rolling_models()));
  check_outputs(o.plot.path.empty() ? std::vector{o.output} : std::vector{o.output, o.plot.path});
  check_picture(o.plot.path);
  switch (case_file::kind_of_case(o.case_file)) {
    case case_file::CaseKind::kParticles:
      return run_particles_sweep(o);
    case case_file::CaseKind::kSwimmer:
      return run_study(o, study_of_swimmer(o));
    case case_file::CaseKind::kRolling:
      return run_study(o, study_of_rolling_sphere(o));
    case case_file::CaseKind::kSphere:
      return run_study(o, study_of_sphere(o));
  }
}

}  // namespace

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
  // The limit is kMostPoints of sweep/variation.cpp.
  add_value(*command, "--samples", o->samples, "N",
            "number of random points in the ranges, in place of the grid")
      ->check(whole_number(1, 1000000000000));
  command->add_option("--seed", o->seed, "seed of the random points")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  add_value(*command, "--models", o->models, kModels,
            fmt::format("comma-separated; default: {}; for a rolling sphere: {}",
                        names_of(reduced_model::sweep_models(), ","),
                        names_of(rolling::rolling_models(), ",")))
      ->delimiter(',');
  add_value(*command, "--reference", o->reference, kModel,
            fmt::format("model that the others are compared with; default: {}, or the first",
                        reduced_model::usual_reference()));
  add_value(*command, "--fit", o->fit, kFile,
            "fit of the lubrication force (JSON); default: the case's [fit] file or exact; for a "
            "swimmer or a rolling sphere, its fit.json");
  add_picture_options(*command, *o);
  command
      ->add_option("--draws", o->draws,
                   "for a case of particles: number of random arrangements at each point")
      ->check(whole_number(1, 1000000000));
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
