#include "app/simulate_stage.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/foreign_files.hpp"
#include "app/progress.hpp"
#include "app/run_copies.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/number.hpp"
#include "reduced_model/fit_uncertainty.hpp"
#include "reduced_model/models.hpp"

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
    if (error.exit_code() != ExitCode::kNotConverged) throw;
    warn(fmt::format("simulate: warning: the fit's uncertainty is not propagated: {}",
                     error.what()));
    return "";
  }
}

}  // namespace

std::vector<std::string> models_to_run(const Case& c, std::vector<std::string> asked) {
  if (asked.empty()) asked = c.models;
  if (asked.empty())
    for (const auto& model : default_models()) asked.emplace_back(model.name);
  return asked;
}

Simulated simulate_case(const Case& c, const FitFile& fit_file,
                        const std::vector<std::string>& models, const OutsideFit& outside) {
  const auto& motion = required_motion(c);
  Simulated simulated;
  simulated.fit_text = fit_file.text;
  const fs::path& fit_path = fit_file.path;
  const Fit fit = parse_fit(fit_file.text, fit_path.string());
  // A fit of another viscosity could be scaled, one of another radius could not; neither is done
  // silently.
  if (fit.viscosity != c.viscosity || fit.radius != c.radius)
    throw_bad_input({fit_path.string()},
                    fmt::format("is of viscosity {} and radius {}; the case has viscosity {} and "
                                "radius {}: tabulate and "
                                "fit for the case",
                                fit.viscosity, fit.radius, c.viscosity, c.radius));
  const LubricationForce force = [&] {
    try {
      return LubricationForce(fit, outside.below, outside.above);
    } catch (const Error& error) {
      throw Error(error.exit_code(), fmt::format("{}: {}", fit_path.string(), error.what()));
    }
  }();
  for (const auto& name : models_to_run(c, models)) {
    throw_if_interrupted();
    const auto choice = find_model(name);
    try {
      simulated.trajectories.push_back(simulate(choice, motion, force));
    } catch (const Error& error) {
      throw Error(error.exit_code(), fmt::format("{}: {}", c.path.string(), error.what()));
    }
    auto& comments = simulated.trajectories.back().provenance;
    comments = identity_of_trajectory(c, simulated.fit_text, outside);
    comments["time_step"] = time_step_of(name, motion);
  }
  throw_if_interrupted();
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

namespace {

/// The fit file of the case's exact drag as it is to stand in the run's folder: the one that is
/// there, if it says the same.
FitFile exact_fit_file(const Case& c, const RunFolder& run, const Provenance& provenance) {
  const std::string text = write_fit(exact_plane_fit(c.viscosity, c.radius));
  if (fs::is_regular_file(run.fit()))
    if (auto there = read_file(run.fit()); without_provenance(there) == text)
      return {run.fit(), std::move(there)};
  return {run.fit(), output_text(run.fit(), TextKind::kJson, text, provenance)};
}

}  // namespace

void simulate_stage(const Case& c, const SimulateRequest& request) {
  const RunFolder run{request.folder};
  (void)required_motion(c);
  fs::path path = request.fit;
  if (path.empty() && c.fit && c.fit->file) path = *c.fit->file;
  const bool exact = path.empty() && c.fit && c.fit->exact;
  const bool of_folder = path.empty() && !exact && fs::is_regular_file(run.fit());
  if (of_folder) path = run.fit();
  if (path.empty() && !exact)
    throw Error(ExitCode::kWrongUsage,
                fmt::format("the case names no drag to run with (file or exact in its section "
                            "[fit]) and there is no {}; give a fit with --fit",
                            run.fit().string()));
  std::vector<fs::path> inputs = {c.path};
  inputs.insert(inputs.end(), c.force_files.begin(), c.force_files.end());
  if (!exact) inputs.push_back(path);
  auto provenance = provenance_of({inputs, {}});
  // The command repeated for another folder finds no fit there.
  if (of_folder) provenance.command.insert(provenance.command.end(), {"--fit", path.string()});
  if (request.fit.empty())
    say(fmt::format("simulate: the drag is {}",
                    exact ? "the exact one near a plane" : "that of " + path.string()));
  const FitFile fit = exact ? exact_fit_file(c, run, provenance) : FitFile{path, read_file(path)};
  check_case_copies(run, c);
  check_fit_copy(run, fit.text);
  refuse_other_kind(run.uncertainty(), "", "uncertainty.json");
  for (const auto& model : models_to_run(c, request.models))
    refuse_other_kind(run.trajectory(model), "", "trajectory");
  write_simulated(run, c, simulate_case(c, fit, request.models, request.outside), provenance);
}

}  // namespace viscontact
