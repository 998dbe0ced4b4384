// The tables of the report as HTML, in the units of the case. Each table names and links the file
// from which its numbers are.
#pragma once

#include <string>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// A sentence that says what was computed, and the parameters of the case.
std::string parameters_table(const results::RunResults& run);

/// Smallest gap, times of contact and distance to the reference of each model.
std::string models_table(const results::RunResults& run);

/// The budget (impulses and works) of each model; empty if no model has one.
std::string budget_table(const results::RunResults& run);

/// The coefficients of the fit and its diagnostics.
std::string fit_table(const results::RunResults& run);

/// The effect of the fit's errors on the smallest gap, in words; empty if it is not known.
std::string uncertainty_words(const results::RunResults& run);

/// How the files of the run were made: commands, inputs with their hashes, versions and times.
/// Throws Error(kBadInput) if the provenance in a file is damaged.
std::string origin_section(const results::RunResults& run);

}  // namespace viscontact::report
