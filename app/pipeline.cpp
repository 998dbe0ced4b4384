#include "app/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/command_options.hpp"
#include "app/comparison_table.hpp"
#include "app/fit_summary.hpp"
#include "app/progress.hpp"
#include "app/provenance.hpp"
#include "app/report.hpp"
#include "app/run_checks.hpp"
#include "app/run_copies.hpp"
#include "app/run_folder.hpp"
#include "app/shift_plot.hpp"
#include "app/tabulate_stage.hpp"
#include "app/versions.hpp"
#include "common/csv.hpp"
#include "common/error.hpp"
#include "common/file.hpp"
#include "common/interrupt.hpp"
#include "common/named.hpp"
#include "reduced_model/comparison.hpp"
#include "reduced_model/fit_uncertainty.hpp"
#include "reduced_model/models.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// True if the file can be read and passes the test; a file that is no such file at all does not
/// count as up to date.
template <class Test>
bool up_to_date(const fs::path& path, const Test& test) {
  if (!fs::is_regular_file(path)) return false;
  try {
    return test();
  } catch (const Error&) {
    return false;
  }
}

/// What identifies the inputs of a trajectory, in its "# key: value" lines.
CsvComments identity_of_trajectory(const Case& c, const std::string& fit_text) {
  CsvComments comments = {{"case", sha256(c.text)},
                          {"fit", content_sha256(fit_text)},
                          {"revision of the models", std::to_string(kModelsRevision)},
                          {"version of Viscontact", VISCONTACT_VERSION}};
  if (!c.force_files.empty()) comments["force"] = sha256(text_of_forces(c));
  return comments;
}

std::vector<std::string> models_to_run(const Case& c, std::vector<std::string> asked) {
  if (asked.empty()) asked = c.models;
  if (asked.empty())
    for (const auto& model : default_models()) asked.emplace_back(model.name);
  return asked;
}

std::string time_step_of(std::string_view model, const Motion& motion) {
  const auto name = find_model(model).model->name;
  if (name == "viscous_contact_exact") return "none";
  if (find_model(model).model->contact != nullptr || name == "explicit_euler")
    return format_number(motion.contact_time_step);
  return name == "reference" ? format_number(motion.reference_time_step) : "variable";
}

/// What the fit's errors do to the motion without inertia; where there is no such motion, no file.
void write_uncertainty_file(const Motion& motion, const Fit& fit, BelowInterval below,
                            AboveInterval above, const fs::path& path,
                            const Provenance& provenance) {
  constexpr std::size_t kTimes = 81;
  try {
    write_output(path, TextKind::kJson,
                 write_uncertainty(propagate_fit(motion, fit, kTimes, below, above)), provenance);
  } catch (const Error& error) {
    if (error.exit_code() != ExitCode::kNotConverged) throw;
    fs::remove(path);
    warn(fmt::format("simulate: warning: the fit's uncertainty is not propagated: {}",
                     error.what()));
  }
}

/// Says so if trajectories of ours were made from different cases or fits: their distances then mix two causes.
void warn_of_different_inputs(const std::vector<Trajectory>& trajectories) {
  for (const auto* key : {"case", "fit"}) {
    const Trajectory* first = nullptr;
    for (const auto& trajectory : trajectories) {
      if (!trajectory.provenance.contains(key)) continue;  // a user's own
      if (first == nullptr) first = &trajectory;
      if (trajectory.provenance.at(key) == first->provenance.at(key)) continue;
      warn(fmt::format("viscontact: warning: {} and {} were made from different {}s", first->model,
                       trajectory.model, key));
      break;
    }
  }
}

/// The place of a trajectory's model in the table of models; beyond it for a user's own.
std::ptrdiff_t rank_of(const fs::path& file) {
  try {
    return find_model(file.stem().string()).model - all_models().data();
  } catch (const Error&) {
    return std::ssize(all_models());
  }
}

/// The files of a folder, if it is there, that are named after models.
std::vector<fs::path> files_of_models(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv" && rank_of(entry.path()) < std::ssize(all_models()))
      files.push_back(entry.path());
  return files;
}

/// The trajectory files of a folder: those in trajectories/ if it is a run's folder, else its own
/// .csv files.
std::vector<fs::path> trajectory_files(const fs::path& folder) {
  const auto inner = RunFolder{folder}.trajectories();
  const fs::path place = fs::is_directory(inner) ? inner : folder;
  if (!fs::is_directory(place))
    throw_bad_input({folder.string()}, "is no folder with trajectories");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".csv" && entry.path().filename() != "table.csv")
      files.push_back(entry.path());
  // In the order of the table of models, then by name.
  std::ranges::sort(files, {},
                    [&](const fs::path& file) { return std::pair(rank_of(file), file); });
  return files;
}

}  // namespace

std::vector<fs::path> files_of_motion(const Case& c) {
  std::vector<fs::path> files = {c.path};
  files.insert(files.end(), c.force_files.begin(), c.force_files.end());
  return files;
}

Fit fit_file(const fs::path& table_path, const ForceTable& table, const FitSettings& settings) {
  try {
    Fit fit = fit_force_table(table, settings);
    if (fs::is_regular_file(table_path))  // a pipe has been read
      fit.table_sha256 = content_sha256(read_file(table_path));
    fit.versions = library_versions();
    return fit;
  } catch (const Error& error) {
    throw Error(error.exit_code(), fmt::format("{}: {}", table_path.string(), error.what()));
  }
}

void fit_stage(const fs::path& table_path, const fs::path& fit_path, const FitSettings& settings,
               const Provenance& provenance) {
  const auto table = read_force_table(table_path);
  throw_if_interrupted();
  const Fit fit = fit_file(table_path, table, settings);
  throw_if_interrupted();
  for (const auto& warning : fit.diagnostics->warnings)
    warn(fmt::format("fit: warning: {}", warning));
  const std::string text = write_fit(fit);
  if (up_to_date(fit_path, [&] { return without_provenance(read_file(fit_path)) == text; })) {
    say(fmt::format("fit: {} is up to date", fit_path.string()));
    return;
  }
  write_output(fit_path, TextKind::kJson, text, provenance);
  say(fit_in_words(fit));
}

void compare_bases_stage(const fs::path& table_path, const FitSettings& settings,
                         const fs::path& plot_path, bool json) {
  const auto provenance = provenance_of({{table_path}, {}});
  const auto table = read_force_table(table_path);
  const auto results = compare_bases(table, settings);
  if (std::ranges::none_of(results,
                           [](const BasisResult& result) { return result.fit.has_value(); }))
    throw_bad_input({table_path.string()}, results.front().failure);
  write_output(plot_path, TextKind::kSvg, plot_bases(table, results), provenance);
  fmt::print("{}", json ? basis_json(results) : basis_table(results));
}

void shift_stage(const fs::path& table_path, const fs::path& fit_path, const fs::path& shift_path,
                 const fs::path& plot_path) {
  const auto provenance = provenance_of({{table_path, fit_path}, {}});
  const auto rough = read_force_table(table_path);
  WallShift shift;
  try {
    shift = fit_wall_shift(rough, LubricationForce(read_fit(fit_path)));
  } catch (const Error& error) {
    throw Error(error.exit_code(),
                fmt::format("{}, {}: {}", table_path.string(), fit_path.string(), error.what()));
  }
  std::string text = write_csv_comments(
      {{"viscontact", "wall shift"},
       {"geometry", rough.geometry},
       {"table", content_sha256(read_file(table_path))},
       {"fit", content_sha256(read_file(fit_path))},
       {"shift", format_number(shift.shift)},
       {"largest_relative_residual", format_number(shift.largest_relative_residual)},
       {"rms_relative_residual", format_number(shift.rms_relative_residual)},
       {"rows", std::to_string(shift.rows.size())}});
  text += "gap,shift,relative_residual,relative_error_estimate\n";
  for (const auto& row : shift.rows)
    text += fmt::format("{},{},{},{}\n", format_number(row.gap), format_number(row.shift),
                        format_number(row.relative_residual),
                        format_number(row.relative_error_estimate));
  const std::string picture =
      plot_path.empty() ? ""
                        : plot_wall_shift(shift, rough.geometry);  // before anything is written
  write_output(shift_path, TextKind::kHashComment, text, provenance);
  if (!plot_path.empty()) write_output(plot_path, TextKind::kSvg, picture, provenance);
  fmt::print("shift {:.6g}; relative residual: largest {:.2g}, rms {:.2g}\n", shift.shift,
             shift.largest_relative_residual, shift.rms_relative_residual);
}

void simulate_stage(const Case& c, const fs::path& fit_path, const fs::path& folder,
                    std::vector<std::string> models, BelowInterval below, AboveInterval above,
                    const Provenance& provenance) {
  const auto& motion = required_motion(c);
  const std::string fit_text = read_file(fit_path);
  const RunFolder run{folder};
  check_case_copies(run, c);
  check_fit_copy(run, fit_text);
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
      return LubricationForce(fit, below, above);
    } catch (const Error& error) {
      throw Error(error.exit_code(), fmt::format("{}: {}", fit_path.string(), error.what()));
    }
  }();
  std::vector<Trajectory> trajectories;
  for (const auto& name : models_to_run(c, std::move(models))) {
    throw_if_interrupted();
    trajectories.push_back(simulate(find_model(name), motion, force));
    trajectories.back().provenance = identity_of_trajectory(c, fit_text);
    trajectories.back().provenance["time_step"] = time_step_of(name, motion);
  }
  write_copies(run, c, fit_text);
  if (fit.basis == kExactPlane)
    fs::remove(run.uncertainty());
  else
    write_uncertainty_file(motion, fit, below, above, run.uncertainty(), provenance);
  // Last: by the trajectories `run` sees whether all this has been done.
  for (const auto& trajectory : trajectories)
    write_output(run.trajectory(trajectory.model), TextKind::kHashComment,
                 write_trajectory(trajectory), provenance);
  say(fmt::format("simulate: {} models", trajectories.size()));
}

void compare_stage(const fs::path& folder, const std::vector<fs::path>& others,
                   const std::string& reference_model, const fs::path& comparison_path,
                   const std::vector<fs::path>& given, bool json) {
  auto files = trajectory_files(folder);
  files.insert(files.end(), others.begin(), others.end());
  if (files.empty()) throw_bad_input({folder.string()}, "has no trajectory files");
  const auto provenance = provenance_of(given.empty() ? Inputs{files, {}} : Inputs{given, files});
  std::vector<Trajectory> trajectories;
  for (const auto& file : files) trajectories.push_back(read_trajectory(file));
  warn_of_different_inputs(trajectories);
  const auto comparison = compare_trajectories(trajectories, reference_model);
  write_output(comparison_path, TextKind::kJson, write_comparison(comparison), provenance);
  fmt::print("{}", json ? write_comparison(comparison) : comparison_table(comparison));
}

void run_stages(const Case& c, const fs::path& folder, int jobs, bool json) {
  const RunFolder run{folder};
  const auto& request = required_fit(c);
  (void)required_motion(c);
  check_case_copies(run, c);  // before the long tabulation
  auto given = files_of_motion(c);
  if (request.file) given.emplace_back(*request.file);
  fs::path fit = run.fit();
  if (request.file) {
    fit = *request.file;
  } else if (request.exact) {
    const std::string text = write_fit(exact_plane_fit(c.viscosity, c.radius));
    if (!up_to_date(fit, [&] { return without_provenance(read_file(fit)) == text; }))
      write_output(fit, TextKind::kJson, text, provenance_of({given, {}}));
  } else {
    check_run(c, models_to_run(c, {}));
    // Its first line, which a table cut short still has.
    refuse_other_kind(run.table().string(), "# case: ", "table of ours");
    tabulate_stage({{c, run.table()}}, jobs);
    throw_if_interrupted();
    fit_stage(run.table(), fit, request.settings, provenance_of({given, {run.table()}}));
  }
  throw_if_interrupted();

  const auto models = models_to_run(c, {});
  const bool has_inertial = std::ranges::find(models, "inertial") != models.end();
  const std::string reference = has_inertial ? "inertial" : models.front();
  const auto provenance = identity_of_trajectory(c, read_file(fit));
  const auto made_from_these = [&](const std::string& model) {
    return up_to_date(run.trajectory(model), [&] {
      const auto comments = read_trajectory(run.trajectory(model)).provenance;
      return std::ranges::all_of(provenance, [&](const auto& line) {
        const auto found = comments.find(line.first);
        return found != comments.end() && found->second == line.second;
      });
    });
  };
  if (std::ranges::all_of(models, made_from_these) && fs::exists(run.case_file())) {
    say("simulate: trajectories are up to date");
    if (up_to_date(
            run.comparison(),
            [&] { return read_comparison(run.comparison()).reference_model == reference; }) &&
        fs::exists(run.report())) {
      say("compare, report: up to date");
      const auto comparison = read_comparison(run.comparison());
      fmt::print("{}", json ? write_comparison(comparison) : comparison_table(comparison));
      return;
    }
  } else {
    // What was made from the old trajectories goes first, so that no crash leaves it beside new
    // ones.
    fs::remove(run.comparison());
    fs::remove(run.report());
    for (const auto& file : files_of_models(run.trajectories())) fs::remove(file);
    simulate_stage(c, fit, folder, models, request.below, request.above,
                   provenance_of(request.file ? Inputs{given, {}} : Inputs{given, {fit}}));
  }
  throw_if_interrupted();
  compare_stage(folder, {}, reference, run.comparison(), given, json);
  throw_if_interrupted();
  write_report(folder, given);
}

}  // namespace viscontact
