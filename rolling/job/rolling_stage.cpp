// Runs the stages one after the other. The texts in check_rolling_files() must be those that the
// files contain, because files are recognized by them.
#include "viscontact/rolling/job/rolling_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "viscontact/common/equal_up_to_rounding.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/json.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/motions/job/pair_fit_stage.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/rolling/job/rolling_page.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::rolling {
namespace {

namespace fs = std::filesystem;

struct RollingFolder {
  fs::path path;
  fs::path table(lubrication::MotionKind motion) const {
    return path / "tables" / fmt::format("{}.csv", to_string(motion));
  }
  fs::path fit() const { return path / "fit.json"; }
  fs::path results() const { return path / "rolling.json"; }
  fs::path trajectory(std::string_view model) const { return path / fmt::format("{}.csv", model); }
};

/// Throws Error(kBadInput) if the results would replace a file that Viscontact did not write.
void check_rolling_files(const RollingFolder& folder) {
  for (const auto& motion : lubrication::all_motions())
    results::refuse_other_kind(folder.table(motion.kind), "# case: ", "table");
  results::refuse_other_kind(folder.fit(), "\"pair fit\"", "fit of a pair");
  results::refuse_other_kind(folder.results(), "\"rolling\"", "rolling.json");
  for (const auto& model : rolling_models())
    results::refuse_other_kind(folder.trajectory(model.name), "# viscontact: rolling sphere",
                               "trajectory of a rolling sphere");
  (void)report::Report(folder.path, kRollingPictures);  // throws for a file of the user
}

/// Computes the tables in the folder and fits them, unless the case names a fit. Strains are left
/// out, because they take as much time as all motions, and no model uses them. If rows of a table
/// fail, `failure` becomes the error that names them.
void make_fit(const RollingCase& c, const RollingFolder& folder, const RollingRequest& request,
              pipeline::RowFailure& failure) {
  if (c.fit) return;
  auto tabulation = c.tabulation.value();
  std::erase_if(tabulation.motions, lubrication::is_strain);
  const auto path_of = [folder](lubrication::MotionKind motion) { return folder.table(motion); };
  failure = pipeline::tabulate_stage(pipeline::case_tables(c.path, c.text, tabulation, path_of),
                                     request.jobs, request.stop);
  pipeline::with_failure(failure, [&] {
    // Not all tables of the folder: strains of an earlier run may be there.
    std::vector<fs::path> files;
    for (const auto motion : tabulation.motions) files.push_back(folder.table(motion));
    motions::fit_pair_stage(files, folder.fit(), {}, request.stop);
  });
}

/// The fit that the case names, or else the fit in the folder, scaled to the case.
motions::PairFit fit_of(const RollingCase& c, const RollingFolder& folder) {
  const auto file = c.fit.value_or(folder.fit());
  return fit_for(c, motions::read_pair_fit(file), file);
}

void tell_of_scaling(const RollingCase& c) {
  if (!c.fit) return;
  const auto fit = motions::read_pair_fit(*c.fit);
  if (!equal_up_to_rounding(fit.radius, c.radius))
    terminal::say(
        "rolling: the fit is that of radius {} and viscosity {}; it is scaled to radius {} and "
        "viscosity {}",
        fit.radius, fit.viscosity, c.radius, c.viscosity);
}

/// The columns of a trajectory except the last one, `contact`, in the order of kColumnNames.
constexpr std::array<double RollingRow::*, 9> kColumns = {&RollingRow::time,
                                                          &RollingRow::gap,
                                                          &RollingRow::position,
                                                          &RollingRow::angle,
                                                          &RollingRow::normal_velocity,
                                                          &RollingRow::velocity,
                                                          &RollingRow::angular_velocity,
                                                          &RollingRow::contact_force,
                                                          &RollingRow::friction_force};
const std::array<std::string, kColumns.size() + 1> kColumnNames = {"time",
                                                                   "gap",
                                                                   "position",
                                                                   "angle",
                                                                   "normal_velocity",
                                                                   "velocity",
                                                                   "angular_velocity",
                                                                   "contact_force",
                                                                   "friction_force",
                                                                   "contact"};

/// The text of MODEL.csv (docs/file-formats.md).
std::string trajectory_csv(const std::string& model, const RollingTrajectory& trajectory) {
  std::string text = write_csv_comments({{"viscontact", "rolling sphere"},
                                         {"model", model},
                                         {"rows", std::to_string(trajectory.size())}});
  text += fmt::format("{}\n", fmt::join(kColumnNames, ","));
  for (const auto& row : trajectory) {
    for (const auto column : kColumns) text += format_number(row.*column) + ",";
    text += fmt::format("{}\n", static_cast<int>(row.contact));
  }
  return text;
}

RollingTrajectory read_trajectory(const fs::path& path) {
  RollingTrajectory trajectory;
  for (const auto& [fields, line] : read_csv(path, kColumnNames, kColumnNames.size()).rows) {
    if (!std::ranges::all_of(fields, [](const auto& field) { return field.has_value(); }))
      throw_bad_input({path.string(), line}, "lacks a number");
    auto& row = trajectory.emplace_back();
    for (std::size_t i = 0; i < kColumns.size(); ++i) row.*kColumns[i] = *fields[i];
    const double contact = *fields.back();
    if (contact != 0 && contact != 1 && contact != 2)
      throw_bad_input({path.string(), line}, "contact is {}; it must be 0, 1 or 2", contact);
    row.contact = static_cast<SolidContact>(static_cast<int>(contact));
  }
  if (trajectory.empty()) throw_bad_input({path.string()}, "has no rows");
  return trajectory;
}

/// The text of rolling.json (docs/file-formats.md).
std::string rolling_json(const RollingResults& results) {
  Json json = {{"kind", "rolling"}, {"title", results.c.title}};
  for (const auto& [model, rows] : results.trajectories) {
    const auto end = end_of(rows, results.c.motion, results.c.radius);
    const auto& last = end.last;
    auto& object = json["models"][model];
    object = {{"gap", last.gap},           {"smallest_gap", end.smallest_gap},
              {"position", last.position}, {"angle", last.angle},
              {"velocity", last.velocity}, {"angular_velocity", last.angular_velocity},
              {"slip", end.slip},          {"contact", static_cast<int>(last.contact)}};
    object["stokes_number"] = stokes_of(results.c, end);
    object["reynolds_number"] =
        reynolds_of(results.c, end) ? Json(*reynolds_of(results.c, end)) : Json(nullptr);
    object["contact_time"] = end.contact_time ? Json(*end.contact_time) : Json(nullptr);
  }
  if (const auto warnings = rolling_warnings(results); !warnings.empty())
    json["warnings"] = warnings;
  for (const auto& model : results.failed) json["failed_models"][model.model] = model.reason;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

/// Runs the models of the case, and keeps the reasons of those that fail. Throws the Error of the
/// first one if all fail.
void run_models(const RollingCase& c, RollingResults& results) {
  for (const auto& model : rolling_models()) {
    const std::string name(model.name);
    if (std::ranges::find(c.models, name) == c.models.end()) continue;
    terminal::show_progress(fmt::format("rolling: {}", name));
    try {
      results.trajectories.emplace_back(name, model.run(c.motion, results.fit));
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::kInterrupted) throw;
      results.failed.push_back({name, error.what(), error.kind(), {}});
    }
    terminal::clear_progress();
  }
  if (results.trajectories.empty()) throw results::error_of(results.failed, 0, c.path);
}

/// Writes the trajectories that are not up to date. Returns true if there were any.
bool write_trajectories(const RollingFolder& folder, const RollingResults& results,
                        const results::Provenance& provenance) {
  bool wrote = false;
  for (const auto& model : rolling_models()) {
    const std::string name(model.name);
    const auto found = std::ranges::find(results.trajectories, name,
                                         [](const auto& trajectory) { return trajectory.first; });
    if (found == results.trajectories.end())
      remove_file(folder.trajectory(name));
    else if (results::write_if_changed(folder.trajectory(name), TextKind::kHashComment,
                                       trajectory_csv(name, found->second), provenance))
      wrote = true;
  }
  return wrote;
}

void say_end(const std::string& model, const RollingRow& last) {
  terminal::say("rolling: {} ends at the gap {:.6g}, velocity {:.6g}, angular velocity {:.6g}",
                model, last.gap, last.velocity, last.angular_velocity);
}

void say_regime(const RollingResults& results) {
  double stokes = 0;
  std::optional<double> reynolds;
  for (const auto& [model, rows] : results.trajectories) {
    const auto end = end_of(rows, results.c.motion, results.c.radius);
    stokes = std::max(stokes, stokes_of(results.c, end));
    if (const auto number = reynolds_of(results.c, end))
      reynolds = std::max(reynolds.value_or(0), *number);
  }
  terminal::say(
      "rolling: largest Stokes number {:.3g}, Reynolds number {}", stokes,
      reynolds ? fmt::format("{:.3g}", *reynolds) : "not known (it needs `density` in [fluid])");
}

}  // namespace

void run_rolling(const RollingRequest& request) {
  assert(request.jobs >= 1);
  RollingResults results;
  results.c = read_rolling_case(request.case_file);
  const RollingFolder folder{request.folder};
  check_rolling_files(folder);
  const LockedFolder lock(folder.path, results::kFolderIsLocked);
  pipeline::RowFailure rows_failed;
  make_fit(results.c, folder, request, rows_failed);
  results.fit = fit_of(results.c, folder);
  tell_of_scaling(results.c);
  std::vector<fs::path> given = {results.c.path};
  if (results.c.fit) given.push_back(*results.c.fit);
  const auto provenance = results::provenance_of(
      {given, results.c.fit ? std::vector<fs::path>{} : std::vector{folder.fit()}});
  results.c.motion.stop = request.stop;
  pipeline::with_failure(rows_failed, [&] { run_models(results.c, results); });
  bool wrote = write_trajectories(folder, results, provenance);
  for (const auto& [model, rows] : results.trajectories) say_end(model, rows.back());
  for (const auto& warning : rolling_warnings(results))
    terminal::warn("rolling: warning: " + warning);
  say_regime(results);
  const auto json = rolling_json(results);
  if (results::write_if_changed(folder.results(), TextKind::kJson, json, provenance)) wrote = true;
  if (wrote || !report::page_is_current(folder.path, kRollingPictures))
    write_rolling_report(results, folder.path, provenance, request.stop);
  else
    terminal::say("rolling: {} is up to date", folder.path.string());
  if (request.json) fmt::print("{}", json);
  pipeline::with_failure(rows_failed, [&] {
    if (!results.failed.empty())
      throw results::error_of(results.failed, results.trajectories.size(), results.c.path);
  });
  if (rows_failed) throw Error(*rows_failed);
}

void report_rolling(const fs::path& path, const StopToken& stop) {
  const RollingFolder folder{path};
  auto files = results::given_inputs(folder.results());
  RollingResults results;
  results.c = read_rolling_case(files.front());
  results.fit = fit_of(results.c, folder);
  if (!results.c.fit) files.push_back(folder.fit());
  files.push_back(folder.results());
  read_json(folder.results(), [&](const Json& json) {
    if (json.contains("failed_models"))
      for (const auto& [model, reason] : json.at("failed_models").items())
        results.failed.push_back({model, reason, ErrorKind::kBadInput, {}});
    for (const auto& [model, state] : json.at("models").items()) {
      files.push_back(folder.trajectory(model));
      results.trajectories.emplace_back(model, read_trajectory(files.back()));
    }
  });
  write_rolling_report(results, path, results::provenance_of({files, {}}), stop);
}

}  // namespace viscontact::rolling
