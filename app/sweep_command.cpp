#include "app/sweep_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "app/command_options.hpp"
#include "app/progress.hpp"
#include "app/sweep_plot.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "sweep/sweep_file.hpp"

namespace viscontact {
namespace {

struct Options {
  std::string case_file, fit, output, reference, plot, x, y;
  std::vector<std::string> vary, models, columns;
  std::uint64_t samples = 0, seed = 1;
  int jobs = default_jobs();
};

/// The command line, and where it is silent the case's [sweep].
SweepPlan plan_of(const Options& o, const Case& c) {
  const SweepRequest request = c.sweep.value_or(SweepRequest{});
  SweepPlan plan;
  plan.case_path = c.path;
  const FitRequest fit = c.fit.value_or(FitRequest{});
  plan.below = fit.below;
  plan.above = fit.above;
  if (!o.fit.empty()) {
    plan.fit = read_fit(o.fit);
  } else if (fit.file) {
    plan.fit = read_fit(*fit.file);
  } else if (fit.exact) {
    plan.fit = exact_plane_fit(c.viscosity, c.radius);
  } else {
    throw Error(ExitCode::kWrongUsage,
                "the case has no fit to run with ([fit] file or exact); give one with --fit");
  }
  for (const auto& text : o.vary.empty() ? request.vary : o.vary)
    plan.variations.push_back(parse_variation(text));
  if (plan.variations.empty())
    throw Error(ExitCode::kWrongUsage, "nothing to vary; give --vary KEY=FROM:TO:COUNT");
  plan.samples = o.samples > 0 ? o.samples : static_cast<std::uint64_t>(request.samples);
  plan.seed = o.seed;
  plan.models = !o.models.empty() ? o.models : request.models;
  if (plan.models.empty()) plan.models = {"inertial", "viscous_contact"};
  plan.reference = !o.reference.empty() ? o.reference : request.reference;
  if (plan.reference.empty()) {
    const bool has_inertial = std::ranges::find(plan.models, "inertial") != plan.models.end();
    plan.reference = has_inertial ? "inertial" : plan.models.front();
  }
  return plan;
}

SweepPlot picture_of(const Options& o, const Case& c, const SweepPlan& plan) {
  const SweepRequest request = c.sweep.value_or(SweepRequest{});
  SweepPlot picture{!o.x.empty() ? o.x : request.x, !o.y.empty() ? o.y : request.y,
                    !o.columns.empty() ? o.columns : request.plot};
  if (picture.x == "motion.mass") picture.x = "sphere.mass";
  if (picture.y == "motion.mass") picture.y = "sphere.mass";
  if (picture.x.empty()) {
    picture.x = plan.variations[0].key;
    if (plan.variations.size() > 1 && plan.samples == 0) picture.y = plan.variations[1].key;
  }
  if (picture.columns.empty())
    for (const auto& model : plan.models) picture.columns.push_back(model + ".minimal_gap");
  return picture;
}

void check_columns(const SweepPlot& picture, const SweepPlan& plan) {
  const auto columns = sweep_columns(plan);
  const auto check = [&](const std::string& name) {
    if (name.empty() || std::ranges::find(columns, name) != columns.end()) return;
    throw Error(ExitCode::kWrongUsage, fmt::format("there is no column '{}' to plot; there are: {}",
                                                   name, fmt::join(columns, ", ")));
  };
  check(picture.x);
  check(picture.y);
  for (const auto& column : picture.columns) {
    const auto slash = column.find('/');
    check(column.substr(0, slash));
    if (slash != std::string::npos) check(column.substr(slash + 1));
  }
}

/// "about 3 min", from the time that the rows so far have taken.
class Remaining {
 public:
  std::string after(std::uint64_t done, std::uint64_t size) {
    if (!first_) first_ = done;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start_;
    if (done <= *first_) return "";
    const double left =
        spent.count() / static_cast<double>(done - *first_) * static_cast<double>(size - done);
    return left > 90 ? fmt::format(", about {:.0f} min left", left / 60)
                     : fmt::format(", about {:.0f} s left", left);
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::optional<std::uint64_t> first_;
};

void run(const Options& o) {
  check_outputs(o.plot.empty() ? std::vector{o.output} : std::vector{o.output, o.plot});
  refuse_other_kind(o.output, "# viscontact: sweep", "sweep");
  if (!o.plot.empty()) refuse_other_kind(o.plot, "<svg", "picture");
  const Case c = read_case(o.case_file);
  const Sweep sweep(plan_of(o, c));
  const SweepPlot picture = picture_of(o, c, sweep.plan());
  if (!o.plot.empty()) check_columns(picture, sweep.plan());

  Remaining remaining;
  auto shown = std::chrono::steady_clock::now();
  const auto computed = write_sweep(
      sweep, o.output, o.jobs, VISCONTACT_VERSION, [&](std::uint64_t done, std::uint64_t size) {
        const auto now = std::chrono::steady_clock::now();
        if (now - shown < std::chrono::milliseconds(200)) return;
        shown = now;
        show_progress(fmt::format("sweep: {} of {}{}", done, size, remaining.after(done, size)));
      });
  clear_progress();
  const auto size = sweep_size(sweep.plan());
  say(computed == 0
          ? fmt::format("sweep: {} is up to date", o.output)
          : fmt::format(
                "sweep: {} rows in {}{}", size, o.output,
                computed < size ? fmt::format(", {} of them from before", size - computed) : ""));
  if (!o.plot.empty()) write_file(o.plot, plot_sweep(o.output, picture));
}

}  // namespace

void add_sweep(CLI::App& app) {
  auto* command =
      app.add_subcommand("sweep", "a case run with many numbers: a row of figures each");
  auto o = std::make_shared<Options>();
  command
      ->add_option("CASE", o->case_file,
                   "case file (TOML); its [sweep] holds defaults for what follows")
      ->required();
  command
      ->add_option("-o,--output", o->output,
                   "rows to write (CSV); an interrupted sweep goes on with the same command")
      ->required();
  command
      ->add_option(
          "--vary", o->vary,
          "KEY=FROM:TO:log:COUNT, KEY=FROM:TO:COUNT or KEY=VALUE,VALUE,...; KEY as in the case: "
          "sphere.mass, motion.external_force[0].value; may be repeated: the grid of all")
      ->type_name("KEY=RANGE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--samples", o->samples,
                   "so many random points of the ranges instead of the grid")
      ->check(CLI::Range(1.0, 1e12))
      ->type_name("N");
  command->add_option("--seed", o->seed, "of the random points")->capture_default_str();
  command->add_option("--models", o->models, "comma-separated; default: inertial,viscous_contact")
      ->delimiter(',');
  command->add_option("--reference", o->reference,
                      "model that the others are compared with; default: inertial, or the first");
  command->add_option(
      "--fit", o->fit,
      "fit of the lubrication force (JSON); default: the case's [fit] file or exact");
  command->add_option("--plot", o->plot,
                      "picture to write (SVG): lines over one key, or a map over two");
  command->add_option("--x", o->x, "key along the picture; default: the first varied");
  command->add_option("--y", o->y, "key up the picture, for a map");
  command
      ->add_option(
          "--column", o->columns,
          "what to draw, comma-separated: MODEL.minimal_gap, MODEL.film_ratio, ..., or COLUMN/KEY")
      ->delimiter(',');
  add_jobs(*command, o->jobs, "points at once");
  command->callback([o] { run(*o); });
}

}  // namespace viscontact
