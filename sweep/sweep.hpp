// A sweep: one case run with many numbers, a row of figures each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact {

/// What is run at each point.
struct SweepPlan {
  std::filesystem::path case_path;
  Fit fit;  ///< scaled to each point's viscosity
  BelowInterval below = BelowInterval::kError;
  AboveInterval above = AboveInterval::kError;
  std::vector<Variation> variations;  ///< at least one
  std::uint64_t samples = 0;          ///< random points; 0: the whole grid
  std::uint64_t seed = 1;
  std::vector<std::string> models;  ///< at least one
  std::string
      reference;  ///< one of them: what the others' distances are to; empty: default_reference
};

/// The plan that a case asks for: its [sweep], its fit. What the case leaves out is empty: variations, fit, reference. Throws Error(kBadInput) if a range of its
/// [sweep] is none or its fit file cannot be read.
SweepPlan planned(const Case& c);

/// "inertial" if it is among the models, else the first.
std::string default_reference(const std::vector<std::string>& models);

/// Number of points.
std::uint64_t sweep_size(const SweepPlan& plan);

/// Names of a row's columns: the keys; for each model MODEL.minimal_gap, MODEL.minimal_gap_time, MODEL.film (recovered from gamma), MODEL.contact_from,
/// MODEL.contact_until, MODEL.sup_gap_distance, MODEL.l1_gap_distance, MODEL.l1_velocity_distance, MODEL.film_ratio (thinnest film over the
/// reference's), MODEL.steps; failure.
std::vector<std::string> sweep_columns(const SweepPlan& plan);

/// Computes rows, any of them, on any thread.
class Sweep {
 public:
  /// Reads the case. Throws Error(kBadInput) if the first or the last point of the plan is no case, has another radius than the fit, or the
  /// case has no [motion]; Error(kWrongUsage) if there is nothing to vary or no fit, the reference is none of the models, a key or model is there twice, or a key
  /// changes no row, because a sweep does not read it or none of the models depends on it.
  explicit Sweep(SweepPlan plan);

  const SweepPlan& plan() const { return plan_; }

  /// The varied numbers of that point as fields of CSV: how its row begins.
  std::string key_fields(std::uint64_t index) const;

  /// The row of that point as a line of CSV. A model that fails leaves its fields and those of its distances empty, and says why in `failure`.
  std::string row(std::uint64_t index) const;

 private:
  Case case_at(std::uint64_t index) const;
  std::vector<std::pair<std::string, double>> point(std::uint64_t index) const;

  SweepPlan plan_;
  CaseTemplate case_;
};

/// Computes the rows from `begin` on, on `jobs` >= 1 threads, and hands them over in order; stops when interrupted() or when `take` throws, which it throws on.
/// Memory does not grow with the number of rows. Returns the number of the row after the last that was taken.
std::uint64_t run_sweep(
    const Sweep& sweep, std::uint64_t begin, int jobs,
    const std::function<void(std::uint64_t index, const std::string& row)>& take);

}  // namespace viscontact
