// A sweep: a case is run many times with other values of its keys, and each run gives a row of
// results (docs/file-formats.md). Lengths, masses and times are in the units of the case. A change
// of the columns must keep their names, because scripts of users read them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/common/stop_token.hpp"
#include "viscontact/lubrication/fit/fit.hpp"
#include "viscontact/sweep/rows.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::sweep {

/// What is computed at each point of a sweep.
struct SweepPlan {
  std::filesystem::path case_path;  ///< the case whose keys are varied
  lubrication::Fit fit;  ///< each point multiplies it by its viscosity over that of the fit
  lubrication::OutsideInterval outside;  ///< drag outside the interval of the fit
  std::vector<Variation> variations;     ///< at least one
  /// Number of random points; 0: the whole grid.
  std::uint64_t samples = 0;
  /// Seed of the random points.
  std::uint64_t seed = 1;
  std::vector<std::string> models;  ///< at least one
  /// The model with which the others are compared, one of `models`; empty:
  /// reduced_model::reference_of.
  std::string reference;
};

/// The plan of the section [sweep] and the fit of a case. Variations, fit and reference are empty
/// if the case does not give them. Throws Error(kBadInput) if a range in [sweep] is not valid or
/// the fit file cannot be read.
SweepPlan planned(const case_file::Case& c);

/// Number of points of a sweep.
std::uint64_t sweep_size(const SweepPlan& plan);

/// Names of the columns of a row: first the varied keys; then, for each model, MODEL.minimal_gap
/// [L], MODEL.minimal_gap_time [T], MODEL.film (recovered from gamma) [L], MODEL.contact_from [T],
/// MODEL.contact_until [T], MODEL.sup_gap_distance, MODEL.l1_gap_distance,
/// MODEL.l1_velocity_distance (distances to the reference), MODEL.film_ratio (thinnest film over
/// that of the reference), MODEL.steps; and finally `failure`.
std::vector<std::string> sweep_columns(const SweepPlan& plan);

/// Computes rows of a sweep, in any order and on any thread.
class Sweep {
 public:
  /// Reads the case. Throws Error(kBadInput) if the case has no [motion], if the first or the last
  /// point of the plan gives no valid case, or if its radius is not that of the fit. Throws
  /// Error(kWrongUsage) if nothing is varied, if there is no fit, if the reference is not one of
  /// the models, if a key or a model occurs twice, or if a key changes no row, because a sweep does
  /// not read it or none of the models depends on it.
  explicit Sweep(SweepPlan plan);

  const SweepPlan& plan() const { return plan_; }  ///< with `reference` filled in

  /// The values of the varied keys at a point, as the CSV fields with which its row begins.
  std::string key_fields(std::uint64_t index) const;

  /// The row of a point as a line of CSV. The fields of a model that fails are empty, and `failure`
  /// says why it failed. If the reference fails, the distances of all models are empty.
  /// Throws Error(kInterrupted) if `stop` requests a stop.
  std::string row(std::uint64_t index, const StopToken& stop = {}) const;

 private:
  case_file::Case case_at(std::uint64_t index) const;
  std::vector<std::pair<std::string, double>> point(std::uint64_t index) const;

  SweepPlan plan_;
  case_file::CaseTemplate case_;
};

/// The rows of a sweep, for its file. `version` is that of Viscontact. The sweep must outlive the
/// result. Throws Error(kBadInput) if the case or one of its files cannot be read.
Rows rows_of(const Sweep& sweep, const std::string& version);

}  // namespace viscontact::sweep
