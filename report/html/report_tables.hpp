// The tables of the report as HTML, in the units of the case. Each table names the file from which
// its numbers are, and links to it.
#pragma once

#include <string>

#include "viscontact/results/run_results.hpp"

namespace viscontact::report {

/// The parameters of the case with their dimensions.
std::string parameters_table(const results::RunResults& run);

/// Smallest gap, times of contact and distance to the reference of each model.
std::string models_table(const results::RunResults& run);

/// The impacts on the solids of each model; empty if there are none.
std::string rebounds_table(const results::RunResults& run);

/// The budget (impulses and works) of each model; empty if no model has one.
std::string budget_table(const results::RunResults& run);

/// The coefficients of the fit and its diagnostics.
std::string fit_table(const results::RunResults& run);

/// The effect of the fit's errors on the smallest gap, in words; empty if it is not known.
std::string uncertainty_words(const results::RunResults& run);

/// How the files of the run were made: commands, inputs with their hashes, versions and times. If
/// the provenance in a file is missing or damaged, the table says so.
std::string origin_section(const results::RunResults& run);

}  // namespace viscontact::report
