// The warnings of the report: what a reader should know before relying on the numbers of a run.
#pragma once

#include <string>
#include <vector>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// A warning of the report.
struct ReportWarning {
  std::string text;  ///< a sentence with numbers, without the full stop
  std::string file;  ///< file of these numbers, relative to the run's folder
};

/// A fit is called poor if its largest relative residual is above this.
inline constexpr double kPoorFit = 0.01;

/// The report warns if more than this share of the random draws of coefficients was refused.
inline constexpr double kManyRefused = 0.01;

/// The warnings of a run, in this order: models that failed, drag from outside the fit's interval,
/// a poor fit, rows less accurate than was asked, spheres that go through the plane, roughness that
/// a model does not know, refused draws, files that were not made from each other. Empty if there
/// is nothing to warn of.
std::vector<ReportWarning> warnings_of(const results::RunResults& run);

}  // namespace viscontact::report
