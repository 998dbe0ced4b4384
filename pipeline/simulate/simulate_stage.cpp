// Chooses the fit of the drag, runs the models of motion of a case and writes their results.
#include "viscontact/pipeline/simulate/simulate_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/pipeline/simulate/run_checks.hpp"
#include "viscontact/pipeline/simulate/run_inputs.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

/// The text of uncertainty.json. It is empty if the fit is exact, or if the motion cannot be
/// computed; then a warning says why. Throws Error(kInterrupted) at a stop.
std::string uncertainty_of(const reduced_model::Motion& motion, const lubrication::Fit& fit,
                           const lubrication::OutsideInterval& outside) {
  // Number of times at which the report shows how uncertain the gap is; docs/file-formats.md states
  // it.
  constexpr std::size_t kTimes = 81;
  if (lubrication::is_exact_plane(fit)) return "";
  try {
    return reduced_model::write_uncertainty(
        reduced_model::propagate_fit(motion, fit, kTimes, outside));
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::kInterrupted) throw;
    terminal::warn("simulate: warning: the fit's uncertainty is not propagated: {}", error.what());
    return "";
  }
}

/// The end of an error message, which says up to which gaps a model would move outside the interval
/// of the fit, by the formulas of OutsideInterval::with_limits(). The text is empty if it would
/// not, or if its motion cannot be computed with these formulas.
std::string estimate_of_gaps(const reduced_model::ModelChoice& choice,
                             const reduced_model::Motion& motion, const lubrication::Fit& fit,
                             const lubrication::OutsideInterval& outside) {
  if (choice.exact_drag || lubrication::is_exact_plane(fit)) return "";
  const auto [low, high] = lubrication::LubricationForce(fit, outside).interval();
  const auto reached = reduced_model::reached_gaps(
      choice, motion, lubrication::LubricationForce(fit, outside.with_limits()));
  if (!reached) return "";
  std::string text;
  if (reached->smallest && *reached->smallest < low)
    text += fmt::format(
        "; the sphere would come down to a gap of about {:.3g} (estimated by the lubrication "
        "limit): tabulate down to there",
        *reached->smallest);
  if (reached->largest > high)
    text += fmt::format(
        "; the sphere would get up to a gap of about {:.3g} (estimated by {}): tabulate up to "
        "there",
        reached->largest,
        lubrication::second_wall_of(fit) ? "the limit at the wall opposite" : "Stokes' drag");
  return text;
}

/// The record of a model that threw `error`. To an error of kind kBadInput estimate_of_gaps() is
/// added, because a gap outside the interval of the fit may be its cause.
results::FailedModel failure_of(const reduced_model::ModelChoice& choice, const Error& error,
                                const reduced_model::Motion& motion, const lubrication::Fit& fit,
                                const lubrication::OutsideInterval& outside) {
  std::string reason = error.what();
  const std::string prefix = fmt::format("model {}: ", choice.name);
  if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
  if (error.kind() == ErrorKind::kBadInput)
    reason += estimate_of_gaps(choice, motion, fit, outside);
  return {choice.name, reason, error.kind(), {}};
}

/// Reads the fit and scales it to the case. If it has another radius or viscosity, a message says
/// so. Throws Error(kBadInput) if the text is no fit or the fit cannot be scaled.
lubrication::Fit fit_of_text(const case_file::Case& c, const FitFile& file) {
  auto fit = lubrication::parse_fit(file.text, file.path.string());
  if (!equal_up_to_rounding(fit.viscosity, c.viscosity) ||
      !equal_up_to_rounding(fit.radius, c.radius))
    terminal::say(
        "simulate: the fit is that of radius {} and viscosity {}{}; it is scaled to radius {} and "
        "viscosity {}",
        fit.radius, fit.viscosity, fit.container.empty() ? "" : ", container: " + fit.container,
        c.radius, c.viscosity);
  return case_file::fit_for(c, std::move(fit), file.path);
}

/// Adds comments that say how the trajectory was computed, and drops rows if the case asks for
/// fewer.
void finish(reduced_model::Trajectory& trajectory, const reduced_model::ModelChoice& choice,
            const reduced_model::Motion& motion, const lubrication::LubricationForce& force) {
  auto& comments = trajectory.provenance;
  const reduced_model::ModelParameter* step = choice.model->time_step;
  comments["time_step"] =
      step != nullptr ? format_number(motion.parameter(*step)) : std::string(choice.model->steps);
  if (motion.output_rows > 0) {
    comments["rows_computed"] = std::to_string(trajectory.rows.size());
    trajectory.rows = reduced_model::fewer_rows(trajectory.rows, motion.output_rows);
  }
  if (choice.model->contact == nullptr) return;
  const auto drag = reduced_model::drag_of(choice, force);
  const auto law = reduced_model::contact_model_of(choice, motion, drag).film_law;
  if (!law.empty()) comments["film_from_gamma_formula"] = law;
}

}  // namespace

std::vector<fs::path> files_of_motion(const case_file::Case& c) {
  std::vector<fs::path> files = {c.path};
  files.insert(files.end(), c.force_files.begin(), c.force_files.end());
  return files;
}

std::vector<std::string> models_to_run(const case_file::Case& c, std::vector<std::string> asked) {
  if (asked.empty()) asked = c.models;
  if (asked.empty())
    for (const auto& model : reduced_model::default_models()) asked.emplace_back(model.name);
  return asked;
}

Simulated simulate_case(const case_file::Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models,
                        const lubrication::OutsideInterval& outside, const StopToken& stop) {
  reduced_model::Motion motion = case_file::required_motion(c);
  motion.stop = stop;
  Simulated simulated;
  simulated.fit_text = fit_file.text;
  const lubrication::Fit fit = fit_of_text(c, fit_file);
  const auto force =
      in_file(fit_file.path.string(), [&] { return lubrication::LubricationForce(fit, outside); });
  const auto names = models_to_run(c, models);
  check_parameters(c, names);
  simulated.made_from = identity_of_trajectory(c, simulated.fit_text, outside);
  for (const auto& name : names) {
    stop.throw_if_stop_requested();
    const auto choice = reduced_model::find_model(name);
    const auto which = fmt::format("{} ({} of {})", name, &name - names.data() + 1, names.size());
    motion.progress = [which, end = motion.end_time,
                       timer = terminal::ProgressTimer()](double time) mutable {
      if (timer.is_due())
        terminal::show_progress(fmt::format("simulate: {}, {:.0f} %", which, 100 * time / end));
    };
    try {
      auto trajectory = reduced_model::simulate(choice, motion, force);
      trajectory.provenance = simulated.made_from;
      if (c.units.are_said()) trajectory.provenance["units"] = c.units.words();
      finish(trajectory, choice, motion, force);
      if (const auto wall = reduced_model::reached_wall(trajectory, motion, force.largest_gap()))
        terminal::warn("simulate: warning: {}: {}", name, *wall);
      simulated.trajectories.push_back(std::move(trajectory));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      simulated.failed.push_back(failure_of(choice, error, motion, fit, outside));
      simulated.failed.back().made_from = simulated.made_from;
    }
  }
  terminal::clear_progress();
  for (const auto& warning : reduced_model::regime_warnings(simulated.trajectories))
    terminal::warn("simulate: warning: {}", warning);
  stop.throw_if_stop_requested();
  if (simulated.trajectories.empty()) throw results::error_of(simulated.failed, 0, c.path);
  simulated.uncertainty = uncertainty_of(motion, fit, outside);
  return simulated;
}

void write_simulated(const results::RunFolder& run, const case_file::Case& c,
                     const Simulated& simulated, const results::Provenance& provenance) {
  write_copies(run, c, simulated.fit_text);
  if (simulated.uncertainty.empty())
    remove_file(run.uncertainty());
  else
    results::write_output(run.uncertainty(), TextKind::kJson, simulated.uncertainty, provenance);
  // Because `run` takes a trajectory as the sign that copies and uncertainty.json are written,
  // trajectories follow them.
  for (const auto& trajectory : simulated.trajectories)
    results::write_output(run.trajectory(trajectory.model), TextKind::kHashComment,
                          reduced_model::write_trajectory(trajectory), provenance);
  auto failed = results::recorded_failures(run, simulated.made_from);
  // Failures of models that this call did not run stay in the record, if their inputs were the
  // same.
  std::erase_if(failed, [&](const results::FailedModel& other) {
    const auto is_it = [&](const auto& model) { return model.model == other.model; };
    return std::ranges::any_of(simulated.trajectories, is_it) ||
           std::ranges::any_of(simulated.failed, is_it);
  });
  failed.insert(failed.end(), simulated.failed.begin(), simulated.failed.end());
  if (failed.empty())
    remove_file(run.failed_models());
  else
    results::write_output(run.failed_models(), TextKind::kJson,
                          results::write_failed_models(failed), provenance);
  for (const auto& model : simulated.failed) {
    remove_file(run.trajectory(model.model));
    // The error with which the command ends gives the reason of the first model.
    if (&model != &simulated.failed.front())
      terminal::say("simulate: model {} failed: {}", model.model, model.reason);
  }
  terminal::say("simulate: {} models", simulated.trajectories.size());
}

FitFile exact_fit_file(const case_file::Case& c, const results::RunFolder& run,
                       const results::Provenance& provenance) {
  const std::string text =
      lubrication::write_fit(lubrication::exact_plane_fit(c.viscosity, c.radius));
  if (results::has_content(run.fit(), text)) return {run.fit(), read_file(run.fit())};
  return {run.fit(), results::output_text(run.fit(), TextKind::kJson, text, provenance)};
}

void simulate_stage(const case_file::Case& c, const SimulateRequest& request) {
  if (c.gravity.value_or(0) > 0)
    terminal::warn(
        "simulate: warning: motion.gravity, {:.6g}, is > 0 and lifts a heavy sphere off the wall; "
        "gravity towards the wall is negative",
        *c.gravity);
  const results::RunFolder run{request.folder};
  (void)case_file::required_motion(c);
  fs::path path = request.fit;
  if (path.empty() && c.fit && c.fit->file) path = *c.fit->file;
  const bool exact = path.empty() && c.fit && c.fit->exact;
  const bool of_folder = path.empty() && !exact && fs::is_regular_file(run.fit());
  if (of_folder) path = run.fit();
  if (path.empty() && !exact)
    throw Error(ErrorKind::kWrongUsage,
                "the drag is not given: the section [fit] of the case has neither 'file' nor "
                "'exact', and there is no {}; {}",
                run.fit().string(), request.remedy);
  auto inputs = files_of_motion(c);
  if (!exact) inputs.push_back(path);
  auto provenance = results::provenance_of({inputs, {}});
  // The recorded command must name the fit of this folder, because `rerun` may repeat the command
  // with another output folder, which has no fit.
  if (of_folder) provenance.command.insert(provenance.command.end(), {"--fit", path.string()});
  if (request.fit.empty())
    terminal::say("simulate: the drag is {}",
                  exact ? "the exact one near a plane" : "that of " + path.string());
  const FitFile fit = exact ? exact_fit_file(c, run, provenance) : FitFile{path, read_file(path)};
  check_case_copies(run, c);
  check_fit_copy(run, fit.text);
  results::refuse_other_kind(run.uncertainty(), "", "uncertainty.json");
  results::refuse_other_kind(run.failed_models(), "", "failed_models.json");
  for (const auto& model : models_to_run(c, request.models))
    results::refuse_other_kind(run.trajectory(model), "", "trajectory");
  const auto simulated = simulate_case(c, fit, request.models, request.outside, request.stop);
  write_simulated(run, c, simulated, provenance);
  if (!simulated.failed.empty())
    throw results::error_of(simulated.failed, simulated.trajectories.size(), c.path);
}

}  // namespace viscontact::pipeline
