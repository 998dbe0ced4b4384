// Decides which stages must run: those whose outputs are missing or were made from other inputs.
#include "viscontact/pipeline/run_stages.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/pipeline/compare_stage.hpp"
#include "viscontact/pipeline/fit_stages.hpp"
#include "viscontact/pipeline/simulate/run_checks.hpp"
#include "viscontact/pipeline/simulate/run_inputs.hpp"
#include "viscontact/pipeline/simulate/simulate_stage.hpp"
#include "viscontact/pipeline/tabulate/tabulate_stage.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/report/report.hpp"
#include "viscontact/results/failed_models.hpp"
#include "viscontact/results/foreign_files.hpp"
#include "viscontact/results/provenance.hpp"
#include "viscontact/results/run_folder.hpp"
#include "viscontact/terminal/progress.hpp"

namespace viscontact::pipeline {
namespace {

namespace fs = std::filesystem;

bool is_fit(const fs::path& path) {
  if (!fs::is_regular_file(path)) return false;
  try {
    (void)lubrication::read_fit(path);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// False if the comparison is missing or damaged.
bool has_reference(const fs::path& path, const std::string& model) {
  try {
    return fs::is_regular_file(path) &&
           reduced_model::read_comparison(path).reference_model == model;
  } catch (const Error&) {
    return false;
  }
}

/// True if uncertainty.json, from which the report was made, has since been deleted.
bool uncertainty_is_lost(const results::RunFolder& run) {
  if (fs::exists(run.uncertainty())) return false;
  try {
    const auto provenance = results::read_provenance(run.report());
    return provenance &&
           std::ranges::any_of(provenance->inputs, [&](const results::InputFile& input) {
             return fs::path(input.file).filename() == run.uncertainty().filename();
           });
  } catch (const Error&) {  // the report is missing or damaged, so it will be made anyway
    return false;
  }
}

/// Throws Error(kBadInput) if a run would replace or delete a file that Viscontact did not write.
/// Must be called before the tabulation, which can take hours.
void check_outputs_of_run(const results::RunFolder& run, bool writes_fit) {
  // An earlier run may have copied a fit that the user wrote by hand. This copy may be replaced,
  // although the copy has no record that Viscontact wrote it.
  const bool is_copy = holds_a_run(run) && is_fit(run.fit());
  if (writes_fit && !is_copy) results::refuse_other_kind(run.fit(), "\"gap_interval\"", "fit");
  results::refuse_other_kind(run.comparison(), "\"reference_model\"", "comparison");
  results::refuse_other_kind(run.uncertainty(), "", "uncertainty.json");
  results::refuse_other_kind(run.failed_models(), "", "failed_models.json");
  (void)report::Report(run.path, report::kPlotNames);  // throws if it would replace a user's file
  for (const auto& file : files_of_models(run.trajectories()))
    results::refuse_other_kind(file, "", "trajectory");
}

/// Makes or finds the fit that the case asks for, and returns its path. `given` are the case and
/// the files of forces that it names. If rows of the table failed, `failure` is set to the error
/// that names them. Throws the errors of the stages tabulate and fit.
fs::path provide_fit(const case_file::Case& c, const results::RunFolder& run,
                     const std::vector<fs::path>& given, int jobs, RowFailure& failure,
                     const StopToken& stop) {
  const auto& request = case_file::required_fit(c);
  if (request.file) return *request.file;
  if (request.exact) {
    const auto fit = exact_fit_file(c, run, results::provenance_of({given, {}}));
    if (!fs::is_regular_file(fit.path) || read_file(fit.path) != fit.text)
      write_file(fit.path, fit.text);
    return fit.path;
  }
  const auto models = models_to_run(c);
  check_run(c, models);
  warn_of_gaps_outside(c, models, stop);
  results::refuse_other_kind(run.table(), "# case: ", "table");
  failure = tabulate_stage({case_table(c, run.table())}, jobs, stop);
  stop.throw_if_stop_requested();
  with_failure(failure, [&] {
    fit_stage(run.table(), run.fit(), request.settings,
              results::provenance_of({given, {run.table()}}), stop);
  });
  return run.fit();
}

}  // namespace

void run_stages(const case_file::Case& c, const fs::path& folder, int jobs, bool json,
                const StopToken& stop) {
  assert(jobs >= 1);
  const results::RunFolder run{folder};
  const auto& request = case_file::required_fit(c);
  (void)case_file::required_motion(c);
  check_case_copies(run, c);  // before the long tabulation
  check_outputs_of_run(run, !request.file);
  auto given = files_of_motion(c);
  if (request.file) given.emplace_back(*request.file);
  RowFailure rows_failed;
  const fs::path fit = provide_fit(c, run, given, jobs, rows_failed, stop);
  stop.throw_if_stop_requested();

  const auto models = models_to_run(c);
  const std::string fit_text = read_file(fit);
  const auto made_from = identity_of_trajectory(c, fit_text, request.outside);
  auto failed = results::recorded_failures(run, made_from);
  std::erase_if(failed, [&](const results::FailedModel& model) {
    return std::ranges::find(models, model.model) == models.end();
  });
  const bool simulated = std::ranges::all_of(models, [&](const std::string& model) {
    return std::ranges::find(failed, model, &results::FailedModel::model) != failed.end() ||
           is_simulated(run, model, made_from);
  });
  bool is_current = simulated && fs::exists(run.case_file()) && !uncertainty_is_lost(run);
  if (is_current) {
    terminal::say("simulate: trajectories are up to date");
    is_current = has_reference(run.comparison(), results::reference_without(models, failed)) &&
                 report::page_is_current(folder, report::kPlotNames);
  } else {
    const auto results = simulate_case(c, {fit, fit_text}, models, request.outside, stop);
    stop.throw_if_stop_requested();
    // Outputs from the old trajectories are removed before the new trajectories are written, so
    // that a run that is killed never leaves both in the folder.
    remove_file(run.comparison());
    remove_file(run.report());
    for (const auto& file : files_of_models(run.trajectories())) remove_file(file);
    write_simulated(run, c, results,
                    results::provenance_of(request.file ? results::Inputs{given, {}}
                                                        : results::Inputs{given, {fit}}));
    failed = results.failed;
  }
  if (is_current) {
    terminal::say("compare, report: up to date");
    print_comparison(reduced_model::read_comparison(run.comparison()), json);
  } else {
    stop.throw_if_stop_requested();
    compare_stage(folder, {}, results::reference_without(models, failed), run.comparison(), given,
                  json, stop);
    stop.throw_if_stop_requested();
    report::write_report(folder, given, stop);
  }
  // These errors are thrown last, so that all files that can be made are written before.
  with_failure(rows_failed, [&] {
    if (!failed.empty()) throw results::error_of(failed, models.size() - failed.size(), c.path);
  });
  if (rows_failed) throw Error(*rows_failed);
}

}  // namespace viscontact::pipeline
