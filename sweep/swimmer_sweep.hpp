// A sweep over the strokes of a swimmer: its displacement, energy and efficiency at each point of a
// grid, from one fit of the resistance matrices. Lengths, masses and times are in the units of the
// case. A change of the columns must keep their names, because scripts of users read them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "viscontact/case_file/swimmer/swimmer_case.hpp"
#include "viscontact/lubrication/resistance/resistance_fit.hpp"
#include "viscontact/sweep/rows.hpp"
#include "viscontact/sweep/variation.hpp"

namespace viscontact::sweep {

/// What is computed at each point of a sweep.
struct SwimmerSweepPlan {
  std::filesystem::path case_path;    ///< the case whose keys are varied
  lubrication::ResistanceFit fit;     ///< each point uses it with its own viscosity
  std::vector<Variation> variations;  ///< at least one
  std::uint64_t samples = 0;          ///< number of random points; 0: the whole grid
  std::uint64_t seed = 1;             ///< seed of the random points
};

/// Computes rows of a sweep, in any order and on any thread.
class SwimmerSweep {
 public:
  /// Reads the case. Throws Error(kBadInput) if the first or the last point of the plan gives no
  /// valid case, or if the radii of the case are not those of the fit. Throws Error(kWrongUsage) if
  /// nothing is varied, if a key is varied twice or changes the table, or if the case has no stroke.
  explicit SwimmerSweep(SwimmerSweepPlan plan);

  /// The varied keys; displacement [L], energy [M L^2/T^2], energy_at_constant_power and efficiency
  /// if the case has [stroke]; the same with the prefix "optimal." if it has [optimal]; `failure`.
  std::vector<std::string> columns() const;

  std::uint64_t size() const;  ///< number of rows

  /// The rows for the sweep's file. `version` is that of Viscontact. The sweep must outlive them.
  Rows rows(const std::string& version) const;

 private:
  std::vector<std::pair<std::string, double>> point(std::uint64_t index) const;
  std::string key_fields(std::uint64_t index) const;
  std::string row(std::uint64_t index, const StopToken& stop) const;

  SwimmerSweepPlan plan_;
  case_file::SwimmerCaseTemplate case_;
  bool has_stroke_ = false, has_optimal_ = false;
};

}  // namespace viscontact::sweep
