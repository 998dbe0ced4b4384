// The warnings of a report: drag and fits that cannot be trusted, accuracy that was not reached,
// models that ignore something in the case (roughness), and files that do not belong together. Gaps
// [L] and times [T] are in the units of the case. report.cpp shows the warnings; nothing is thrown
// but the errors of reading a file of the folder.
#pragma once

#include <string>
#include <vector>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// A fit counts as poor if its largest relative residual [1] is above this.
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

/// The warnings of a run, in this order: models that failed, drag from outside the fit's interval,
/// a poor fit, rows less accurate than was asked, spheres that go through the plane, roughness that
/// a model does not know, refused draws, files that were not made from each other. Empty if there
/// is nothing to warn of.
std::vector<ReportWarning> warnings_of(const results::RunResults& run);

}  // namespace viscontact::report
