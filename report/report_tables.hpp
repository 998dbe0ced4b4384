// The report's numbers, as HTML; each table says and links the file that it is from.
#pragma once

#include <string>

#include "viscontact/results/run_results.hpp"

namespace viscontact {

/// What was computed, in a sentence, and the case's numbers.
std::string parameters_table(const RunResults& run);

/// Smallest gaps, contact and distances of each model.
std::string models_table(const RunResults& run);

/// Impulses and works of each model; empty if there are none.
std::string budget_table(const RunResults& run);

/// The fit's coefficients and how far to trust them.
std::string fit_table(const RunResults& run);

/// What the fit's errors do to the smallest gap; empty if that is not known.
std::string uncertainty_words(const RunResults& run);

}  // namespace viscontact
