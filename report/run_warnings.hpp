// The warnings in the report of one sphere: drag and fits that cannot be trusted, accuracy that was
// not reached, models that ignore the roughness of the case, and files that do not belong together.
// Gaps [L] and times [T] are in the units of the case. report.cpp shows the warnings. Files that
// cannot be read throw Error(kBadInput). A change of a limit changes the reports of earlier runs
// when they are made again.
#pragma once

#include <string>
#include <vector>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// A fit counts as poor if its largest relative residual [1] is above this; a free choice.
inline constexpr double kPoorFit = 0.01;

/// A warning of the report.
struct ReportWarning {
  std::string text;  ///< a sentence with numbers, without the full stop
  std::string file;  ///< file of these numbers, relative to the run's folder
};

/// The file of a trajectory, relative to the run's folder.
inline std::string trajectory_name(const std::string& model) {
  return "trajectories/" + model + ".csv";
}

/// The warnings of a run, in this order: models that failed, gaps outside the fit's interval, a
/// poor fit, rows less accurate than was asked, spheres that go through the plane, models that
/// ignore the roughness, draws of coefficients that were refused, files that were not made from
/// each other. Empty if there is nothing to warn of. Each trajectory must have a row (not checked).
/// Throws Error(kBadInput) if a file cannot be read, if the fit's drag is not positive, or if a
/// contact model refuses the motion; std::bad_optional_access if the case has no motion.
std::vector<ReportWarning> warnings_of(const results::RunResults& run);

}  // namespace viscontact::report
