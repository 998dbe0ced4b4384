// The output files begin with the texts such as "# viscontact: sweep", by which they are
// recognised.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/app/arguments/interrupt.hpp"
#include "viscontact/app/commands/sweep/sweep_options.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/particle_runs/sweep/particles_sweep_stage.hpp"
#include "viscontact/pipeline/dry_run.hpp"
#include "viscontact/pipeline/simulate/simulate_stage.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/rolling/case/rolling_study.hpp"
#include "viscontact/sweep/sphere_study.hpp"
#include "viscontact/swimmer/case/swimmer_case.hpp"
#include "viscontact/swimmer/case/swimmer_study.hpp"

namespace viscontact::app {
namespace {

/// Replaces those members of `points` for which an option is given: the varied keys (--vary), the
/// number of random samples (--samples), and the seed (--seed), which always has a value.
void set_points(const SweepOptions& o, sweep::Points& points) {
  if (!o.vary.empty()) {
    points.variations.clear();
    points.place.reset();
  }
  for (const auto& text : o.vary)
    points.variations.push_back(
        from_option("--vary", [&] { return sweep::parse_variation(text); }));
  if (o.samples > 0) points.samples = o.samples;
  points.seed = o.seed;
}

/// True if an option is given that only sweeps of particles have.
bool is_for_particles(const SweepOptions& o) {
  return o.array.is_slurm() || o.array.gather || !o.array.task.empty() || o.keep_runs ||
         o.draws > 0;
}

sweep::SpherePlan sphere_plan(const SweepOptions& o, const case_file::Case& c) {
  sweep::SpherePlan plan = sweep::planned_sphere(c);
  if (!o.fit.empty()) plan.fit = lubrication::read_fit(o.fit);
  set_points(o, plan.points);
  if (!o.models.empty()) {
    plan.models = o.models;
    // If --models leaves out the reference model of the case, the study takes another reference
    // (reduced_model::reference_of()).
    if (std::ranges::find(plan.models, plan.reference) == plan.models.end()) plan.reference.clear();
  }
  if (!o.reference.empty()) plan.reference = o.reference;
  return plan;
}

}  // namespace

CaseStudy study_of_sphere(const SweepOptions& o) {
  check_models("--models", o.models);
  if (is_for_particles(o))
    throw Error(ErrorKind::kWrongUsage,
                "--launcher slurm, --gather, --task, --keep-runs and --draws are for cases of many "
                "particles; a row of one sphere takes milliseconds");
  results::refuse_other_kind(o.output, "# viscontact: sweep", "sweep");
  const case_file::Case c = case_file::read_case(o.case_file);
  sweep::SpherePlan plan = sphere_plan(o, c);
  if (plan.fit.basis.empty())
    throw Error(ErrorKind::kWrongUsage,
                "the drag is not given: the section [fit] of the case has neither 'file' nor "
                "'exact'; give a fit with --fit");
  CaseStudy s{.files = pipeline::files_of_motion(c),
              .part = "model",
              .request = c.sweep.value_or(case_file::SweepRequest{})};
  if (!o.fit.empty())
    s.files.emplace_back(o.fit);
  else if (c.fit && c.fit->file)
    s.files.emplace_back(*c.fit->file);
  for (const auto& model : plan.models) s.columns.push_back(model + ".minimal_gap");
  s.study = sweep::sphere_study(std::move(plan), VISCONTACT_VERSION);
  return s;
}

CaseStudy study_of_swimmer(const SweepOptions& o) {
  if (is_for_particles(o) || !o.models.empty() || !o.reference.empty())
    throw Error(ErrorKind::kWrongUsage,
                "--launcher slurm, --gather, --task, --keep-runs, --draws, --models and "
                "--reference are not for cases of a swimmer; leave them out");
  if (o.fit.empty())
    throw Error(ErrorKind::kWrongUsage,
                "the resistance matrices are not given; give with --fit the file fit.json that "
                "`viscontact swimmer CASE -o FOLDER` writes");
  results::refuse_other_kind(o.output, "# viscontact: sweep of a swimmer", "sweep of a swimmer");
  sweep::Points points;
  set_points(o, points);
  CaseStudy s{
      .study = swimmer::swimmer_study(o.case_file, std::move(points),
                                      swimmer::read_resistance_fit(o.fit), VISCONTACT_VERSION),
      .files = swimmer::files_of(swimmer::read_swimmer_case(o.case_file)),
      .part = "stroke"};
  s.files.emplace_back(o.fit);
  for (const char* column : {"displacement", "optimal.displacement"})
    if (std::ranges::find(s.study.results, column) != s.study.results.end())
      s.columns.emplace_back(column);
  return s;
}

CaseStudy study_of_rolling_sphere(const SweepOptions& o) {
  if (is_for_particles(o) || !o.reference.empty())
    throw Error(ErrorKind::kWrongUsage,
                "--launcher slurm, --gather, --task, --keep-runs, --draws and --reference are not "
                "for cases of a rolling sphere; leave them out");
  results::refuse_other_kind(o.output, "# viscontact: sweep of a rolling sphere",
                             "sweep of a rolling sphere");
  const auto c = rolling::read_rolling_case(o.case_file);
  auto plan = rolling::planned_rolling(c);
  set_points(o, plan.points);
  plan.models = o.models.empty() ? c.models : o.models;
  if (!o.fit.empty()) plan.fit_path = o.fit;
  if (plan.fit_path.empty())
    throw Error(ErrorKind::kWrongUsage,
                "the resistances are not given; give with --fit the file fit.json that `viscontact "
                "rolling CASE -o FOLDER` writes");
  CaseStudy s{.files = {o.case_file, plan.fit_path},
              .part = "model",
              .request = c.sweep.value_or(case_file::SweepRequest{})};
  for (const auto& model : plan.models) s.columns.push_back(model + ".velocity");
  s.study = rolling::rolling_study(std::move(plan), VISCONTACT_VERSION);
  return s;
}

particles::ParticlesSweep sweep_of_particles(const SweepOptions& o) {
  if (!o.models.empty() || !o.reference.empty() || !o.fit.empty())
    throw Error(ErrorKind::kWrongUsage,
                "--models, --reference and --fit are for cases of one sphere; leave them out");
  if (!o.plot.path.empty() && (o.array.is_slurm() || !o.array.task.empty()))
    throw Error(
        ErrorKind::kWrongUsage,
        "--plot needs the rows of all tasks; give it with --gather, when they are finished");
  const auto means = particles::path_of_means(o.output);
  results::refuse_other_kind(o.output, "# viscontact: sweep of particles", "sweep of particles");
  results::refuse_other_kind(means, "# viscontact: means of a sweep", "table of means");
  auto points = particles::planned_particles(o.case_file);
  set_points(o, points);
  if (o.draws > 0) points.draws = o.draws;
  if (points.variations.empty() && points.draws == 0)
    throw Error(ErrorKind::kWrongUsage,
                "there is nothing to vary; give --vary KEY=FROM:TO:COUNT or --draws N");
  return {o.case_file, std::move(points)};
}

CaseStudy study_of_particles(const particles::ParticlesSweep& sweep) {
  const auto c = particles::read_particles_case(sweep.case_path());
  CaseStudy s{.study = sweep.study(VISCONTACT_VERSION, {}),
              .files = {sweep.case_path()},
              .part = "run",
              .request = c.sweep.value_or(case_file::SweepRequest{}),
              .columns = {c.setting.fluid ? "mean_apparent_viscosity" : "contacts"}};
  for (const auto& file : particles::files_of(c)) s.files.push_back(file);
  return s;
}

void sweep_many_particles(const SweepOptions& o, const particles::ParticlesSweep& sweep) {
  const particles::ParticlesSweepRequest request{
      o.output, o.jobs, o.keep_runs, freefem_flow::start_fluid_solver, interrupt_token()};
  if (o.dry_run) {
    fmt::print("{}", pipeline::dry_run_text(
                         {particles::dry_run(sweep, o.output, freefem_flow::start_fluid_solver,
                                             interrupt_token())},
                         o.jobs, o.json));
  } else if (o.array.is_slurm()) {
    // Each task reads the section [sweep] of the case itself, so it gets only the options that were
    // given, and the seed, which always has a value.
    std::vector<std::string> options;
    for (const auto& text : o.vary) options.insert(options.end(), {"--vary", text});
    if (o.samples > 0) options.insert(options.end(), {"--samples", std::to_string(o.samples)});
    if (o.draws > 0) options.insert(options.end(), {"--draws", std::to_string(o.draws)});
    options.insert(options.end(), {"--seed", std::to_string(o.seed)});
    if (o.keep_runs) options.emplace_back("--keep-runs");
    with_remedy(kRemedyOfSlurm, [&] {
      particles::submit_sweep(sweep, array_request(o.array, o.output, *o.jobs_option, o.jobs),
                              options);
    });
  } else if (o.array.gather) {
    with_remedy(kRemedyOfGather, [&] { particles::gather_sweep(sweep, request); });
  } else if (!o.array.task.empty()) {
    particles::share_of_sweep(sweep, request, share_of(o.array));
  } else {
    particles::sweep_particles(sweep, request);
  }
}

}  // namespace viscontact::app
