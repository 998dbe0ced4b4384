// A change of a limit alters reports that are made again.
#include "viscontact/report/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/hash/sha256.hpp"
#include "viscontact/reduced_model/models/models.hpp"
#include "viscontact/results/provenance.hpp"

namespace viscontact::report {
namespace {

/// Share of the random draws that may be refused without a warning.
constexpr double kManyRefused = 0.01;

struct Warnings {
  std::vector<ReportWarning> all{};

  /// Adds a warning about numbers in `file`; the other arguments are those of fmt::format.
  template <class... Numbers>
  void add(const std::string& file, fmt::format_string<Numbers...> text, Numbers&&... numbers) {
    all.push_back({fmt::format(text, std::forward<Numbers>(numbers)...), file});
  }
};

/// Warns of gaps, and of films from gamma, outside the fit's interval.
void add_extrapolation(Warnings& warnings, const results::RunResults& run) {
  if (run.fit.terms.empty()) return;  // the exact drag is valid at all gaps
  const auto [low, high] = run.fit.gap_interval;
  const lubrication::LubricationForce force(run.fit,
                                            {lubrication::BelowInterval::kLubricationLimit});
  for (const auto& trajectory : run.trajectories) {
    const auto choice = reduced_model::known_model(trajectory.model);
    assert(!trajectory.rows.empty());
    if (!choice || choice->exact_drag) continue;
    const auto [first, last] =
        std::ranges::minmax_element(trajectory.rows, {}, &reduced_model::TrajectoryRow::gap);
    const double smallest = first->gap, largest = last->gap;
    const bool contact = choice->model->contact != nullptr;
    // While a contact model is in contact, its gap is 0 or constant and no drag is computed.
    // Therefore its film from gamma is compared with the interval.
    const double thinnest = contact ? trajectory.film_from_gamma.value_or(low) : smallest;
    if (thinnest > 0 && thinnest < low)
      warnings.add(
          trajectory_name(trajectory.model),
          "Extrapolation: {} gets down to {} {:.4g}, below the smallest fitted gap, {:.4g}",
          trajectory.model, contact ? "a film of" : "a gap of", thinnest, low);
    const bool drag_at_distance =
        !contact ||
        reduced_model::contact_model_of(*choice, run.c.motion.value(), force).drag.has_value();
    if (largest > high && drag_at_distance)
      warnings.add(
          trajectory_name(trajectory.model),
          "Extrapolation: {} gets up to a gap of {:.4g}, above the largest fitted gap, {:.4g}",
          trajectory.model, largest, high);
  }
}

void add_second_wall(Warnings& warnings, const results::RunResults& run) {
  const auto wall = lubrication::second_wall_of(run.fit);
  if (!wall) return;
  for (const auto& trajectory : run.trajectories)
    if (const auto text =
            reduced_model::reached_wall(trajectory, run.c.motion.value(), wall->largest_gap))
      warnings.add(trajectory_name(trajectory.model), "{}: {}", trajectory.model, *text);
}

void add_regime(Warnings& warnings, const results::RunResults& run) {
  for (const auto& warning : reduced_model::regime_warnings(run.trajectories))
    warnings.add("comparison.json", "{}", warning);
}

void add_failed_models(Warnings& warnings, const results::RunResults& run) {
  for (const auto& failed : run.comparison.failed_models)
    warnings.add("failed_models.json", "{} failed and has no trajectory: {}", failed.model,
                 failed.reason);
}

/// Warns if residuals of the fit are larger than the table's error estimates. Each residual is
/// compared with the estimate of its own row, because that of another row may be much larger.
void add_coarser_than_table(Warnings& warnings, const lubrication::FitDiagnostics& d) {
  const auto& worst = d.worst_to_estimate;
  if (d.misfit != lubrication::Misfit::kBasis || !worst) return;
  warnings.add("fit.json",
               "The fit is coarser than the table: {} of {} rows have a relative residual above "
               "their own error estimate, most of all the row at gap {:.4g} ({:.2g}, which is "
               "{:.2g} times its estimate); another basis can do better",
               d.rows_beyond_estimate, d.rows, worst->gap, std::abs(worst->relative_residual),
               worst->ratio);
}

void add_poor_fit(Warnings& warnings, const lubrication::Fit& fit) {
  const auto& diagnostics = fit.diagnostics;
  if (std::abs(fit.largest_relative_residual) > kPoorFit)
    warnings.add(
        "fit.json",
        "Poor fit: the largest relative residual is {:.2g}{}; a fit is called poor above {:g}",
        fit.largest_relative_residual,
        diagnostics ? fmt::format(" (at gap {:.4g})", diagnostics->worst_gap) : "", kPoorFit);
  if (!diagnostics) return;
  for (const auto& warning : diagnostics->warnings) warnings.add("fit.json", "Fit: {}", warning);
  add_coarser_than_table(warnings, *diagnostics);
}

/// Compares the error estimates of the rows with the accuracy that the case asks for.
void add_unmet_accuracy(Warnings& warnings, const results::RunResults& run) {
  if (!run.table || !run.c.tabulation) return;
  const double asked = run.c.tabulation->relative_accuracy;
  const auto unmet = std::ranges::count_if(
      run.table->rows, [&](const auto& row) { return row.relative_error_estimate > asked; });
  if (unmet == 0) return;
  const auto worst = std::ranges::max_element(run.table->rows, {},
                                              &lubrication::MotionRow::relative_error_estimate);
  warnings.add("table.csv",
               "Accuracy not met: {} of {} rows of the table have an error estimate above the "
               "relative {:.2g} asked for, the largest {:.2g} at gap {:.4g}",
               unmet, run.table->rows.size(), asked, worst->relative_error_estimate, worst->gap);
}

/// Warns of models without contact whose gap ends at 0, because the sphere went through the plane.
void add_passage_through_plane(Warnings& warnings, const results::RunResults& run) {
  for (const auto& trajectory : run.trajectories) {
    const auto choice = reduced_model::known_model(trajectory.model);
    if (!choice || choice->model->contact != nullptr || trajectory.rows.back().gap > 0) continue;
    warnings.add(trajectory_name(trajectory.model),
                 "The sphere of {} goes through the plane at time {:.4g}, although the drag of a "
                 "film forbids it: the time step is too long",
                 trajectory.model, trajectory.rows.back().time);
  }
}

/// Warns of models without solid contact whose smallest gap is less than the sum of the roughness
/// heights of sphere and plane [L], at which the solids would touch.
void add_roughness(Warnings& warnings, const results::RunResults& run) {
  const auto& motion = run.c.motion.value();
  const double roughness = motion.roughness[0] + motion.roughness[1];
  for (const auto& trajectory : run.trajectories) {
    const auto choice = reduced_model::known_model(trajectory.model);
    if (!choice || choice->model->contact != nullptr) continue;
    const double smallest =
        std::ranges::min(trajectory.rows, {}, &reduced_model::TrajectoryRow::gap).gap;
    if (smallest < roughness)
      warnings.add(
          trajectory_name(trajectory.model),
          "{} ignores the roughness: its gap falls to {:.4g}, but the solids would touch at "
          "{:.4g}. Solids touch in the contact models and in inertial_rough (motion.models), and "
          "in 'viscontact rolling', at incline 0 too, where friction acts on them",
          trajectory.model, smallest, roughness);
  }
}

void add_refused_draws(Warnings& warnings, const results::RunResults& run) {
  if (!run.uncertainty) return;
  const auto& u = *run.uncertainty;
  if (static_cast<double>(u.refused) > kManyRefused * static_cast<double>(u.draws))
    warnings.add("uncertainty.json",
                 "{} of {} draws of the fit's coefficients were refused, because they give no "
                 "possible drag; the interval from the others is too narrow",
                 u.refused, u.draws);
}

/// Warns of files that were made from other files than those in the folder, by the hashes of case
/// and fit in the head of a trajectory, and of the table in a fit.
void add_other_origin(Warnings& warnings, const results::RunResults& run) {
  const auto fit_hash = results::content_sha256(read_file(run.folder.fit()));
  const std::array<std::pair<std::string, std::string>, 2> inputs = {
      {{"case", sha256(run.c.text)}, {"fit", fit_hash}}};
  for (const auto& trajectory : run.trajectories)
    for (const auto& [key, hash] : inputs) {
      const auto found = trajectory.provenance.find(key);
      if (found == trajectory.provenance.end() || found->second == hash) continue;
      warnings.add(trajectory_name(trajectory.model),
                   "{} was made from another {} than the one in this folder", trajectory.model,
                   key);
    }
  if (run.table && !run.fit.table_sha256.empty() &&
      run.fit.table_sha256 != results::content_sha256(read_file(run.folder.table())))
    warnings.add("fit.json", "The fit was made from another table than the one in this folder");
  for (const auto& model : run.comparison.models)
    if (std::ranges::find(run.trajectories, model.model, &reduced_model::Trajectory::model) ==
        run.trajectories.end())
      warnings.add("comparison.json",
                   "The trajectory of {} is not in this folder and in no plot; copy it into "
                   "trajectories/ and compare again",
                   model.model);
}

/// Warns of trajectories that were written again after the comparison was made from them.
void add_old_comparison(Warnings& warnings, const results::RunResults& run) {
  std::vector<results::InputFile> compared;
  try {
    if (const auto provenance = results::read_provenance(run.folder.comparison()))
      compared = provenance->inputs;
  } catch (const Error&) {  // a damaged record; the section "How it was made" says so
  }
  for (const auto& trajectory : run.trajectories) {
    const auto file = run.folder.trajectory(trajectory.model);
    std::set<std::string> hashes;  // of the files of this name that were compared
    for (const auto& input : compared)
      if (std::filesystem::path(input.file).filename() == file.filename())
        hashes.insert(input.sha256);
    if (!hashes.empty() && !hashes.contains(sha256(read_file(file))))
      warnings.add("comparison.json",
                   "The comparison was made from another trajectory of {} than the one in this "
                   "folder; compare again",
                   trajectory.model);
  }
}

}  // namespace

std::vector<ReportWarning> warnings_of(const results::RunResults& run) {
  Warnings warnings;
  add_failed_models(warnings, run);
  add_extrapolation(warnings, run);
  add_poor_fit(warnings, run.fit);
  add_unmet_accuracy(warnings, run);
  add_passage_through_plane(warnings, run);
  add_second_wall(warnings, run);
  add_regime(warnings, run);
  add_roughness(warnings, run);
  add_refused_draws(warnings, run);
  add_other_origin(warnings, run);
  add_old_comparison(warnings, run);
  return warnings.all;
}

}  // namespace viscontact::report
