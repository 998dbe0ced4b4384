// `sweep` of a case of one sphere (sweep_options.hpp): its plan, the choice of what its picture
// shows, and the messages. The rows are computed by sweep/.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/app/commands/interrupt.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/simulate/simulate_stage.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/pictures/sweep_plot.hpp"
#include "viscontact/results/picture_kind.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/sweep/sweep.hpp"

namespace viscontact::app {
namespace {

/// The plan of the sweep. Options of the command line decide; for those that are missing, the
/// section [sweep] of the case decides.
sweep::SweepPlan plan_of(const SweepOptions& o, const case_file::Case& c) {
  sweep::SweepPlan plan = sweep::planned(c);
  if (!o.fit.empty()) plan.fit = lubrication::read_fit(o.fit);
  if (!o.vary.empty()) plan.variations = variations_of(o);
  if (o.samples > 0) plan.samples = o.samples;
  plan.seed = o.seed;
  if (!o.models.empty()) {
    plan.models = o.models;
    // The reference of the case need not be among the models of the command line.
    if (std::ranges::find(plan.models, plan.reference) == plan.models.end()) plan.reference.clear();
  }
  if (!o.reference.empty()) plan.reference = o.reference;
  return plan;
}

/// What to draw. Options of the command line decide. Where they are missing, the section [sweep] of
/// the case decides, provided that the sweep has the keys and columns that it names; otherwise the
/// first varied keys are the axes and the smallest gaps are drawn. Throws Error(kWrongUsage) if a
/// map of random samples was asked for.
report::SweepPlot picture_of(const SweepOptions& o, const case_file::Case& c,
                             const sweep::SweepPlan& plan) {
  const case_file::SweepRequest request = c.sweep.value_or(case_file::SweepRequest{});
  const auto is_varied = [&](const std::string& key) {
    return std::ranges::find(plan.variations, key, &sweep::Variation::key) != plan.variations.end();
  };
  const auto columns = sweep::sweep_columns(plan);
  const auto is_there = [&](const std::string& column) {
    const auto slash = column.find('/');
    return std::ranges::find(columns, column.substr(0, slash)) != columns.end() &&
           (slash == std::string::npos || is_varied(column.substr(slash + 1)));
  };
  report::SweepPlot picture{o.x, o.y, o.columns};
  for (auto* axis : {&picture.x, &picture.y})
    if (*axis == "motion.mass") *axis = "sphere.mass";
  if (picture.x.empty() && picture.y.empty()) {
    if (is_varied(request.x)) picture.x = request.x;
    if (is_varied(request.y) && plan.samples == 0) picture.y = request.y;
  }
  if (picture.columns.empty() && std::ranges::all_of(request.plot, is_there))
    picture.columns = request.plot;
  if (picture.x.empty()) {
    const auto free = std::ranges::find_if(plan.variations, [&](const sweep::Variation& v) {
      return v.key != picture.y && v.count > 1;
    });
    picture.x = free != plan.variations.end() ? free->key : plan.variations[0].key;
    const auto other = std::ranges::find_if(plan.variations, [&](const sweep::Variation& v) {
      return v.key != picture.x && v.count > 1;
    });
    if (picture.y.empty() && plan.samples == 0 && other != plan.variations.end())
      picture.y = other->key;
  }
  if (!picture.y.empty() && plan.samples > 0)
    throw Error(ErrorKind::kWrongUsage,
                "a map can be drawn of a grid only, not of random samples; leave out --y");
  if (picture.columns.empty())
    for (const auto& model : plan.models) picture.columns.push_back(model + ".minimal_gap");
  return picture;
}

/// Throws Error(kWrongUsage) if the sweep does not have the axes and columns of the picture.
void check_columns(const report::SweepPlot& picture, const sweep::SweepPlan& plan) {
  const auto columns = sweep::sweep_columns(plan);
  const auto check = [&](const std::string& name) {
    if (std::ranges::find(columns, name) != columns.end()) return;
    throw Error(ErrorKind::kWrongUsage,
                fmt::format("there is no column '{}' to plot; the columns are: {}", name,
                            fmt::join(columns, ", ")));
  };
  for (const auto& axis : {picture.x, picture.y}) {
    if (axis.empty()) continue;
    const auto key = std::ranges::find(plan.variations, axis, &sweep::Variation::key);
    if (key == plan.variations.end() || (key->count < 2 && plan.samples == 0))
      throw Error(
          ErrorKind::kWrongUsage,
          fmt::format(
              "'{}' cannot be an axis of the plot; an axis must be a key that is varied over at "
              "least two values",
              axis));
  }
  for (const auto& column : picture.columns) {
    const auto slash = column.find('/');
    check(column.substr(0, slash));
    if (slash != std::string::npos) check(column.substr(slash + 1));
  }
}

}  // namespace

void sweep_sphere(const SweepOptions& o) {
  if (o.array.is_slurm() || o.array.gather || !o.array.task.empty() || o.keep_runs || o.draws > 0)
    throw Error(ErrorKind::kWrongUsage,
                "--launcher slurm, --gather, --task, --keep-runs and --draws are for cases of many "
                "particles; a row of one sphere takes milliseconds");
  results::refuse_other_kind(o.output, "# viscontact: sweep", "sweep");
  const case_file::Case c = case_file::read_case(o.case_file);
  sweep::SweepPlan plan = plan_of(o, c);
  if (plan.variations.empty())
    throw Error(ErrorKind::kWrongUsage, "there is nothing to vary; give --vary KEY=FROM:TO:COUNT");
  if (plan.fit.basis.empty())
    throw Error(ErrorKind::kWrongUsage,
                "the drag is not given: the section [fit] of the case has neither 'file' nor "
                "'exact'; give a fit with --fit");
  const sweep::Sweep sweep(std::move(plan));
  const report::SweepPlot picture =
      o.plot.empty() ? report::SweepPlot{} : picture_of(o, c, sweep.plan());
  if (!o.plot.empty()) check_columns(picture, sweep.plan());

  if (o.dry_run) {
    fmt::print("{}",
               pipeline::dry_run_text({pipeline::dry_run(sweep::rows_of(sweep, VISCONTACT_VERSION),
                                                         o.output, interrupt_token())},
                                      o.jobs, o.json));
    return;
  }
  auto files = pipeline::files_of_motion(c);
  if (!o.fit.empty())
    files.emplace_back(o.fit);
  else if (c.fit && c.fit->file)
    files.emplace_back(*c.fit->file);
  write_rows(o, sweep::rows_of(sweep, VISCONTACT_VERSION), files, "model");
  if (o.plot.empty()) return;
  const auto kind = results::picture_kind(o.plot)->kind;
  results::write_output(o.plot, kind,
                        report::plot_sweep(o.output, picture, kind, interrupt_token()),
                        results::provenance_of(results::Inputs{files, {o.output}}));
}

}  // namespace viscontact::app
