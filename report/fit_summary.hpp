// A fit in words, and bases side by side.
#pragma once

#include <string>
#include <vector>

#include "viscontact/fitting/basis_comparison.hpp"

namespace viscontact {

/// A line or a few: basis, residuals, what the misfit comes from, outliers.
std::string fit_in_words(const Fit& fit);

/// A table of lines, one a basis, and a line that names the best.
std::string basis_table(const std::vector<BasisResult>& results);

/// The same as JSON: a list of objects, each the fit file of a basis, or "basis" and "failure".
std::string basis_json(const std::vector<BasisResult>& results);

/// Relative residuals of every basis over the gap, beside the table's error estimates, as SVG. Throws Error(kExternalProgram) as draw_svg.
std::string plot_bases(const ForceTable& table, const std::vector<BasisResult>& results);

}  // namespace viscontact
