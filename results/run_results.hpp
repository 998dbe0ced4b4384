// What a run's folder holds, read.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "viscontact/case_file/case_file.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/force_table.hpp"
#include "viscontact/reduced_model/comparison.hpp"
#include "viscontact/reduced_model/fit_uncertainty.hpp"
#include "viscontact/reduced_model/trajectory.hpp"
#include "viscontact/results/run_folder.hpp"

namespace viscontact {

struct RunResults {
  RunFolder folder;
  Case c;
  Fit fit;
  Comparison comparison;
  std::vector<Trajectory>
      trajectories;  ///< those of the comparison's models that are there; at least one
  std::optional<ForceTable> table;  ///< of the fit; none if the run needs none
  std::optional<FitUncertainty> uncertainty;
};

/// Throws Error(kBadInput) if case, fit, comparison or all trajectories are missing, or a file is wrong.
RunResults read_run(const std::filesystem::path& folder);

/// The files that were read.
std::vector<std::filesystem::path> files_of(const RunResults& results);

}  // namespace viscontact
