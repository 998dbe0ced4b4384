// What a reader should know before trusting a run's numbers.
#pragma once

#include <string>
#include <vector>

#include "viscontact/results/run_results.hpp"

namespace viscontact {

struct ReportWarning {
  std::string text;  ///< a sentence with its numbers, without the full stop
  std::string file;  ///< where they are from, relative to the run's folder
};

/// A fit is called poor from this largest relative residual on.
inline constexpr double kPoorFit = 0.01;

/// Of the draws of coefficients, the share from which on those refused are worth a word.
inline constexpr double kManyRefused = 0.01;

/// Drag taken from outside the fitted interval, a poor fit, rows less accurate than asked, spheres through the plane, files that were not made
/// from each other. In that order; empty: nothing to warn of.
std::vector<ReportWarning> warnings_of(const RunResults& run);

}  // namespace viscontact
