// A fit in words, and the fits in several bases side by side.
#pragma once

#include <string>
#include <vector>

#include "viscontact/fitting/basis_comparison.hpp"

namespace viscontact {

/// One or a few lines: basis, residuals, the cause of the misfit, outliers.
std::string fit_in_words(const Fit& fit);

/// A table with one line for each basis, and a last line that names the best basis.
std::string basis_table(const std::vector<BasisResult>& results);

/// The results as JSON: a list with an object for each basis, which is its fit file, or has "basis"
/// and "failure" if the fit failed.
std::string basis_json(const std::vector<BasisResult>& results);

/// An SVG of the relative residuals of every basis over the gap, beside the table's error
/// estimates. Throws Error(kExternalProgram) as draw_svg does.
std::string plot_bases(const ForceTable& table, const std::vector<BasisResult>& results);

}  // namespace viscontact
