// The warnings in the report of one sphere.
#pragma once

#include <string>
#include <vector>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// A fit counts as poor if the size of its largest relative residual [1] is above this number.
inline constexpr double kPoorFit = 0.01;

struct ReportWarning {
  std::string text;  ///< a sentence with numbers, without a full stop at its end
  std::string file;  ///< that the numbers come from, relative to the run's folder
};

/// The file of the trajectory of `model`, relative to the run's folder.
inline std::string trajectory_name(const std::string& model) {
  return "trajectories/" + model + ".csv";
}

/// The warnings of a run, in this order: models that failed, gaps outside the fit's interval, a
/// poor fit, rows of the table that are less accurate than the case asks, spheres that go through
/// the plane, models that ignore the roughness, random draws of the fit's coefficients that were
/// refused, and files that were not made from each other. Each trajectory must have a row. Throws
/// Error(kBadInput) if a file cannot be read, if the fit's drag is not positive, or if a contact
/// model refuses the motion; std::bad_optional_access if the case has no motion.
std::vector<ReportWarning> warnings_of(const results::RunResults& run);

}  // namespace viscontact::report
