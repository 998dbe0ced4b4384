#include "app/simulate_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/foreign_files.hpp"
#include "app/progress.hpp"
#include "app/run_copies.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/number.hpp"
#include "reduced_model/fewer_rows.hpp"
#include "reduced_model/fit_uncertainty.hpp"
#include "reduced_model/models.hpp"
#include "reduced_model/reached_gaps.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBelowKey = "drag below the fit";
constexpr const char* kAboveKey = "drag above the fit";

/// What identifies the inputs of a trajectory, in its "# key: value" lines.
CsvComments identity_of_trajectory(const Case& c, const std::string& fit_text,
                                   const OutsideFit& outside) {
  CsvComments comments = {{"case", sha256(c.text)},
                          {"fit", content_sha256(fit_text)},
                          {"revision of the models", std::to_string(kModelsRevision)},
                          {"version of Viscontact", VISCONTACT_VERSION}};
  if (!c.force_files.empty()) comments["force"] = sha256(text_of_forces(c));
  if (outside.below != BelowInterval::kError)
    comments[kBelowKey] =
        outside.below == BelowInterval::kTheoryLimit ? "theory's limit" : "lubrication limit";
  if (outside.above != AboveInterval::kError) comments[kAboveKey] = "Stokes' limit";
  return comments;
}

/// True if a trajectory with these lines was made from those inputs.
bool is_made_from(const CsvComments& comments, const CsvComments& identity) {
  const auto value = [](const CsvComments& of, const std::string& key) {
    const auto found = of.find(key);
    return found == of.end() ? std::string() : found->second;
  };
  const auto same = [&](const std::string& key) {
    return value(comments, key) == value(identity, key);
  };
  return same(kBelowKey) && same(kAboveKey) &&
         std::ranges::all_of(identity, [&](const auto& line) { return same(line.first); });
}

std::string time_step_of(std::string_view model, const Motion& motion) {
  const auto name = find_model(model).model->name;
  if (name == "viscous_contact_exact") return "none";
  if (find_model(model).model->contact != nullptr || name == "explicit_euler")
    return format_number(motion.contact_time_step);
  return name == "reference" ? format_number(motion.reference_time_step) : "variable";
}

/// What the fit's errors do to the motion without inertia; nothing where there is no such motion, or the fit is exact.
std::string uncertainty_of(const Motion& motion, const Fit& fit, const OutsideFit& outside) {
  constexpr std::size_t kTimes = 81;
  if (fit.basis == kExactPlane) return "";
  try {
    return write_uncertainty(propagate_fit(motion, fit, kTimes, outside.below, outside.above));
  } catch (const Error& error) {
    if (error.exit_code() == ExitCode::kInterrupted) throw;
    warn(fmt::format("simulate: warning: the fit's uncertainty is not propagated: {}",
                     error.what()));
    return "";
  }
}

/// Shows on a terminal how far a model has come in the motion's time, ten times a second at most.
class ProgressOfModel {
 public:
  /// `which`: the model in words.
  ProgressOfModel(std::string which, double end_time)
      : which_(std::move(which)), end_time_(end_time) {}

  void operator()(double time) {
    constexpr auto kBetween = std::chrono::milliseconds(100);
    const auto now = std::chrono::steady_clock::now();
    if (now - shown_ < kBetween) return;
    shown_ = now;
    show_progress(fmt::format("simulate: {}, {:.0f} %", which_, 100 * time / end_time_));
  }

 private:
  std::string which_;
  double end_time_;
  std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

/// How far beyond the fit's interval a model goes, as the end of a message; empty if it does not, or
/// if that cannot be said. The drag is continued by its limits below and above the interval.
std::string estimate_of_gaps(const ModelChoice& choice, const Motion& motion, const Fit& fit,
                             OutsideFit outside) {
  if (choice.exact_drag || fit.basis == kExactPlane) return "";
  const auto [low, high] = LubricationForce(fit, outside.below, outside.above).interval();
  if (outside.below == BelowInterval::kError) outside.below = BelowInterval::kLubricationLimit;
  if (outside.above == AboveInterval::kError) outside.above = AboveInterval::kStokesLimit;
  const auto reached =
      reached_gaps(choice, motion, LubricationForce(fit, outside.below, outside.above));
  if (!reached) return "";
  std::string text;
  if (reached->smallest && *reached->smallest < low)
    text += fmt::format(
        "; the sphere would come down to a gap of about {:.3g} (estimated by the lubrication "
        "limit): tabulate down to there",
        *reached->smallest);
  if (reached->largest > high)
    text += fmt::format(
        "; the sphere would get up to a gap of about {:.3g} (estimated by Stokes' drag): tabulate "
        "up to there",
        reached->largest);
  return text;
}

/// The record of a model that failed with this error of simulate().
FailedModel failure_of(const ModelChoice& choice, const Error& error, const Motion& motion,
                       const Fit& fit, const OutsideFit& outside) {
  std::string reason = error.what();
  const std::string prefix = fmt::format("model {}: ", choice.name);
  if (reason.starts_with(prefix)) reason.erase(0, prefix.size());
  if (error.exit_code() == ExitCode::kBadInput)
    reason += estimate_of_gaps(choice, motion, fit, outside);
  return {choice.name, reason, error.exit_code(), {}};
}

/// Throws Error(kBadInput) naming the case if a parameter of a model is wrong, whatever the drag is.
void check_parameters(const Case& c, const std::vector<std::string>& models) {
  const LubricationForce exact(exact_plane_fit(c.viscosity, c.radius));
  for (const auto& name : models) try {
      check_model(find_model(name), required_motion(c), exact);
    } catch (const Error& error) {
      throw Error(error.exit_code(), fmt::format("{}: {}", c.path.string(), error.what()));
    }
}

/// The failures that the folder records of other models than these with the same inputs.
std::vector<FailedModel> other_failures(const RunFolder& run, const Simulated& simulated) {
  std::vector<FailedModel> others;
  try {
    others = read_failed_models(run.failed_models());
  } catch (const Error&) {  // a damaged record is replaced
  }
  std::erase_if(others, [&](const FailedModel& other) {
    const auto is_it = [&](const auto& model) { return model.model == other.model; };
    return other.made_from != simulated.made_from ||
           std::ranges::any_of(simulated.trajectories, is_it) ||
           std::ranges::any_of(simulated.failed, is_it);
  });
  return others;
}

}  // namespace

std::vector<std::string> models_to_run(const Case& c, std::vector<std::string> asked) {
  if (asked.empty()) asked = c.models;
  if (asked.empty())
    for (const auto& model : default_models()) asked.emplace_back(model.name);
  return asked;
}

Simulated simulate_case(const Case& c, const fs::path& fit_path,
                        const std::vector<std::string>& models, const OutsideFit& outside) {
  Motion motion = required_motion(c);
  Simulated simulated;
  simulated.fit_text = read_file(fit_path);
  const Fit fit = read_fit(fit_path);
  // A fit of another viscosity could be scaled, one of another radius could not; neither is done
  // silently.
  if (fit.viscosity != c.viscosity || fit.radius != c.radius)
    throw_bad_input(
        {fit_path.string()},
        fmt::format(
            "is of viscosity {} and radius {}; the case has {} and {}: tabulate and fit for it",
            fit.viscosity, fit.radius, c.viscosity, c.radius));
  const LubricationForce force = [&] {
    try {
      return LubricationForce(fit, outside.below, outside.above);
    } catch (const Error& error) {
      throw Error(error.exit_code(), fmt::format("{}: {}", fit_path.string(), error.what()));
    }
  }();
  const auto names = models_to_run(c, models);
  check_parameters(c, names);
  simulated.made_from = identity_of_trajectory(c, simulated.fit_text, outside);
  for (const auto& name : names) {
    throw_if_interrupted();
    const auto choice = find_model(name);
    const auto which = fmt::format("{} ({} of {})", name, &name - names.data() + 1, names.size());
    motion.progress = ProgressOfModel(which, motion.end_time);
    try {
      simulated.trajectories.push_back(simulate(choice, motion, force));
    } catch (const Error& error) {
      if (error.exit_code() == ExitCode::kInterrupted) throw;
      simulated.failed.push_back(failure_of(choice, error, motion, fit, outside));
      simulated.failed.back().made_from = simulated.made_from;
      continue;
    }
    auto& comments = simulated.trajectories.back().provenance;
    comments = simulated.made_from;
    comments["time_step"] = time_step_of(name, motion);
    auto& rows = simulated.trajectories.back().rows;
    if (motion.output_rows > 0) {
      comments["rows_computed"] = std::to_string(rows.size());
      rows = fewer_rows(rows, motion.output_rows);
    }
    if (choice.model->contact != nullptr) {
      const auto drag = drag_of(choice, force);
      const auto law = choice.model->contact(motion_of(choice, motion), drag).film_law;
      if (!law.empty()) comments["recovered_film"] = law;
    }
  }
  clear_progress();
  throw_if_interrupted();
  if (simulated.trajectories.empty()) throw error_of(simulated.failed, 0, c.path);
  simulated.uncertainty = uncertainty_of(motion, fit, outside);
  return simulated;
}

void write_simulated(const RunFolder& run, const Case& c, const Simulated& simulated,
                     const Provenance& provenance) {
  write_copies(run, c, simulated.fit_text);
  if (simulated.uncertainty.empty())
    remove_file(run.uncertainty());
  else
    write_output(run.uncertainty(), TextKind::kJson, simulated.uncertainty, provenance);
  // Last: by the trajectories `run` sees whether all this has been done.
  for (const auto& trajectory : simulated.trajectories)
    write_output(run.trajectory(trajectory.model), TextKind::kHashComment,
                 write_trajectory(trajectory), provenance);
  auto failed = other_failures(run, simulated);
  failed.insert(failed.end(), simulated.failed.begin(), simulated.failed.end());
  if (failed.empty())
    remove_file(run.failed_models());
  else
    write_output(run.failed_models(), TextKind::kJson, write_failed_models(failed), provenance);
  for (const auto& model : simulated.failed) {
    remove_file(run.trajectory(model.model));
    // The reason of the first is in the error that ends the command.
    if (&model != &simulated.failed.front())
      say(fmt::format("simulate: model {} failed: {}", model.model, model.reason));
  }
  say(fmt::format("simulate: {} models", simulated.trajectories.size()));
}

bool is_simulated(const RunFolder& run, const std::string& model, const Case& c,
                  const std::string& fit_text, const OutsideFit& outside) {
  const auto file = run.trajectory(model);
  if (!fs::is_regular_file(file)) return false;
  try {
    return is_made_from(read_trajectory(file).provenance,
                        identity_of_trajectory(c, fit_text, outside));
  } catch (const Error&) {  // no trajectory at all is not up to date
    return false;
  }
}

std::vector<FailedModel> recorded_failures(const RunFolder& run,
                                           const std::vector<std::string>& models, const Case& c,
                                           const std::string& fit_text, const OutsideFit& outside) {
  try {
    auto failed = read_failed_models(run.failed_models());
    const auto made_from = identity_of_trajectory(c, fit_text, outside);
    std::erase_if(failed, [&](const FailedModel& model) {
      return model.made_from != made_from || std::ranges::find(models, model.model) == models.end();
    });
    return failed;
  } catch (const Error&) {  // a damaged record is none: the models are run again
    return {};
  }
}

void simulate_stage(const Case& c, const fs::path& fit_path, const fs::path& folder,
                    const std::vector<std::string>& models, const OutsideFit& outside,
                    const Provenance& provenance) {
  const RunFolder run{folder};
  check_case_copies(run, c);
  check_fit_copy(run, read_file(fit_path));
  refuse_other_kind(run.uncertainty(), "", "uncertainty.json");
  refuse_other_kind(run.failed_models(), "", "failed_models.json");
  for (const auto& model : models_to_run(c, models))
    refuse_other_kind(run.trajectory(model), "", "trajectory");
  const auto simulated = simulate_case(c, fit_path, models, outside);
  write_simulated(run, c, simulated, provenance);
  if (!simulated.failed.empty())
    throw error_of(simulated.failed, simulated.trajectories.size(), c.path);
}

}  // namespace viscontact
