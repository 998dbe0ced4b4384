// The stages fit, compare and shift, and the main job. Before the main job simulates again, it
// removes the outputs that depend on the old trajectories; a change must keep this order, so that a
// run that is killed never leaves outputs that do not belong together.
#include "viscontact/pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "viscontact/common/csv.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/named.hpp"
#include "viscontact/common/number.hpp"
#include "viscontact/common/system/interrupt.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/pipeline/run_checks.hpp"
#include "viscontact/pipeline/run_copies.hpp"
#include "viscontact/pipeline/simulate_stage.hpp"
#include "viscontact/pipeline/tabulate_stage.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/report/comparison_table.hpp"
#include "viscontact/report/fit_summary.hpp"
#include "viscontact/report/flow/shift_plot.hpp"
#include "viscontact/report/report.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/results/versions.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact {
namespace {

namespace fs = std::filesystem;

/// True if `path` is a file and `test` returns true. A test that throws an Error, because the file
/// is damaged or of another kind, counts as false.
template <class Test>
bool up_to_date(const fs::path& path, const Test& test) {
  if (!fs::is_regular_file(path)) return false;
  try {
    return test();
  } catch (const Error&) {
    return false;
  }
}

/// Warns if the trajectories were made from different cases or fits, because the distances between
/// them then have two causes. Trajectories that the user wrote have no such record and are skipped.
void warn_of_different_inputs(const std::vector<Trajectory>& trajectories) {
  for (const auto* key : {"case", "fit"}) {
    const Trajectory* first = nullptr;
    for (const auto& trajectory : trajectories) {
      if (!trajectory.provenance.contains(key)) continue;
      if (first == nullptr) first = &trajectory;
      if (trajectory.provenance.at(key) == first->provenance.at(key)) continue;
      warn(fmt::format("viscontact: warning: {} and {} were made from different {}s", first->model,
                       trajectory.model, key));
      break;
    }
  }
}

/// The index of a trajectory's model in the registry of models; the size of the registry if the
/// file is not named after a model.
std::ptrdiff_t rank_of(const fs::path& file) {
  try {
    return find_model(file.stem().string()).model - all_models().data();
  } catch (const Error&) {
    return std::ssize(all_models());
  }
}

/// The CSV files of a folder that are named after models; none if the folder does not exist.
std::vector<fs::path> files_of_models(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".csv" && rank_of(entry.path()) < std::ssize(all_models()))
      files.push_back(entry.path());
  return files;
}

/// The trajectory files of a folder: those in its trajectories/ if it is a run's folder, otherwise
/// the .csv files in the folder itself. Throws Error(kBadInput) if the folder does not exist.
std::vector<fs::path> trajectory_files(const fs::path& folder) {
  const auto inner = RunFolder{folder}.trajectories();
  const fs::path place = fs::is_directory(inner) ? inner : folder;
  if (!fs::is_directory(place))
    throw_bad_input({folder.string()}, "is no folder with trajectories");
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(place))
    if (entry.path().extension() == ".csv" && entry.path().filename() != "table.csv")
      files.push_back(entry.path());
  // First the models in the order of the registry, then the user's files by name.
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
    if (fs::is_regular_file(table_path))  // a pipe cannot be read a second time
      fit.table_sha256 = content_sha256(read_file(table_path));
    fit.versions = library_versions();
    return fit;
  } catch (const Error& error) {
    throw Error(error.kind(), fmt::format("{}: {}", table_path.string(), error.what()));
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
  // The numbers come first because the picture needs gnuplot, which may be missing.
  fmt::print("{}", json ? basis_json(results) : basis_table(results));
  write_output(plot_path, TextKind::kSvg, plot_bases(table, results), provenance);
}

void shift_stage(const fs::path& table_path, const fs::path& fit_path, const fs::path& shift_path,
                 const fs::path& plot_path) {
  const auto provenance = provenance_of({{table_path, fit_path}, {}});
  const auto rough = read_force_table(table_path);
  WallShift shift;
  try {
    shift = fit_wall_shift(rough, LubricationForce(read_fit(fit_path)));
  } catch (const Error& error) {
    throw Error(error.kind(),
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
  write_output(shift_path, TextKind::kHashComment, text, provenance);
  fmt::print("shift {:.6g}; relative residual: largest {:.2g}, rms {:.2g}\n", shift.shift,
             shift.largest_relative_residual, shift.rms_relative_residual);
  // The picture comes last because it needs gnuplot, which may be missing.
  if (!plot_path.empty())
    write_output(plot_path, TextKind::kSvg, plot_wall_shift(shift, rough.geometry), provenance);
}

void compare_stage(const fs::path& folder, const std::vector<fs::path>& others,
                   const std::string& reference_model, const fs::path& comparison_path,
                   const std::vector<fs::path>& given, bool json) {
  auto files = trajectory_files(folder);
  files.insert(files.end(), others.begin(), others.end());
  if (files.empty()) throw_bad_input({folder.string()}, "has no trajectory files");
  auto inputs = files;
  if (const auto failed = RunFolder{folder}.failed_models(); fs::is_regular_file(failed))
    inputs.push_back(failed);
  const auto provenance = provenance_of(given.empty() ? Inputs{inputs, {}} : Inputs{given, inputs});
  std::vector<Trajectory> trajectories;
  for (const auto& file : files) trajectories.push_back(read_trajectory(file));
  warn_of_different_inputs(trajectories);
  const auto failed = failures_without(trajectories, RunFolder{folder});
  auto comparison =
      compare_trajectories(trajectories, reference_among(trajectories, failed, reference_model));
  comparison.failed_models = failed;
  write_output(comparison_path, TextKind::kJson, write_comparison(comparison), provenance);
  fmt::print("{}", json ? write_comparison(comparison) : comparison_table(comparison));
}

namespace {

/// True if the report used uncertainty.json, which has since been deleted.
bool uncertainty_is_lost(const RunFolder& run) {
  if (fs::exists(run.uncertainty())) return false;
  try {
    const auto provenance = read_provenance(run.report());
    return provenance && std::ranges::any_of(provenance->inputs, [&](const InputFile& input) {
             return fs::path(input.file).filename() == run.uncertainty().filename();
           });
  } catch (const Error&) {  // the report is missing or damaged, so it will be made anyway
    return false;
  }
}

/// Throws Error(kBadInput) if a run would replace or delete a file that Viscontact did not write.
/// Called before any work is done, because the tabulation can take hours.
void check_outputs_of_run(const RunFolder& run, bool writes_fit) {
  // The folder of an earlier run may hold a copy of a fit that the user wrote by hand.
  const bool is_copy = holds_a_run(run) && up_to_date(run.fit(), [&] {
                         (void)read_fit(run.fit());
                         return true;
                       });
  if (writes_fit && !is_copy) refuse_other_kind(run.fit(), "\"gap_interval\"", "fit");
  refuse_other_kind(run.comparison(), "\"reference_model\"", "comparison");
  refuse_other_kind(run.uncertainty(), "", "uncertainty.json");
  refuse_other_kind(run.failed_models(), "", "failed_models.json");
  check_report_files(run.path);
  for (const auto& file : files_of_models(run.trajectories()))
    refuse_other_kind(file, "", "trajectory");
}

}  // namespace

void run_stages(const Case& c, const fs::path& folder, int jobs, bool json) {
  const RunFolder run{folder};
  const auto& request = required_fit(c);
  (void)required_motion(c);
  check_case_copies(run, c);  // before the long tabulation
  check_outputs_of_run(run, !request.file);
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
    check_run(c, models_to_run(c));
    warn_of_gaps_outside(c, models_to_run(c));
    refuse_other_kind(run.table(), "# case: ", "table");
    tabulate_stage({{c, run.table()}}, jobs);
    throw_if_interrupted();
    fit_stage(run.table(), fit, request.settings, provenance_of({given, {run.table()}}));
  }
  throw_if_interrupted();

  const auto models = models_to_run(c);
  const OutsideFit outside{request.below, request.above};
  const std::string fit_text = read_file(fit);
  auto failed = recorded_failures(run, models, c, fit_text, outside);
  const bool simulated = std::ranges::all_of(models, [&](const std::string& model) {
    return std::ranges::find(failed, model, &FailedModel::model) != failed.end() ||
           is_simulated(run, model, c, fit_text, outside);
  });
  if (simulated && fs::exists(run.case_file()) && !uncertainty_is_lost(run)) {
    say("simulate: trajectories are up to date");
    if (up_to_date(run.comparison(),
                   [&] {
                     return read_comparison(run.comparison()).reference_model ==
                            reference_without(models, failed);
                   }) &&
        report_is_current(folder)) {
      say("compare, report: up to date");
      const auto comparison = read_comparison(run.comparison());
      fmt::print("{}", json ? write_comparison(comparison) : comparison_table(comparison));
      if (!failed.empty()) throw error_of(failed, models.size() - failed.size(), c.path);
      return;
    }
  } else {
    const auto results = simulate_case(c, {fit, fit_text}, models, outside);
    throw_if_interrupted();
    // Outputs that were made from the old trajectories are removed before the new trajectories are
    // written, so that a crash never leaves both in the folder.
    remove_file(run.comparison());
    remove_file(run.report());
    for (const auto& file : files_of_models(run.trajectories())) remove_file(file);
    write_simulated(run, c, results,
                    provenance_of(request.file ? Inputs{given, {}} : Inputs{given, {fit}}));
    failed = results.failed;
  }
  throw_if_interrupted();
  compare_stage(folder, {}, reference_without(models, failed), run.comparison(), given, json);
  throw_if_interrupted();
  write_report(folder, given);
  // This error is thrown last, so that the results of the other models are complete.
  if (!failed.empty()) throw error_of(failed, models.size() - failed.size(), c.path);
}

}  // namespace viscontact
