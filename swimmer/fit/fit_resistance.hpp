// Fits the resistance matrices of a table by a function of the gaps (ResistanceFit), and says how
// far the fit can be trusted.
#pragma once

#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// The fit that interpolates all rows of the table. The number of lubrication terms is the one with
/// the smallest largest_left_one_out_error among those for which the rest of each matrix is
/// positive definite. Throws Error(kBadInput) if the rows are not all combinations of at least
/// three values of each gap, each once.
ResistanceFit fit_resistance(const ResistanceTable& table);

/// The fits that a result is computed with again to see how exact it is.
struct PerturbedFits {
  /// For each gap the fit whose degree in this gap is one less, by least squares. The change of a
  /// result is about the error of the polynomials.
  std::vector<ResistanceFit> lower_degrees;
  /// Fits of tables in which each entry is changed by its error estimate, with random signs.
  std::vector<ResistanceFit> table_errors;
};

/// `fit` must be that of `table`. The random signs are the same in each call.
PerturbedFits perturbed_fits(const ResistanceTable& table, const ResistanceFit& fit);

}  // namespace viscontact::swimmer
