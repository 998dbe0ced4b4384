// Fits the resistance matrices of a table by a function of the gaps (ResistanceFit), and makes
// perturbed fits, from which the swimmer's results get their error estimates. Lengths, masses and
// times are in the units of the table. The stage of a swimmer calls it. A change must keep that the
// fit meets every row of the table.
#pragma once

#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// The fit that interpolates all rows of the table. The number of lubrication terms is the one with
/// the smallest largest_left_one_out_error among those for which each matrix minus its lubrication
/// is positive definite. Throws Error(kBadInput) if the rows are not all combinations of at least
/// three values of each gap, each combination once.
ResistanceFit fit_resistance(const ResistanceTable& table);

/// Fits with which a result is computed again; its changes are estimates of its errors.
struct PerturbedFits {
  /// For each gap the least-squares fit whose polynomials have one degree less in this gap. The
  /// change of a result is about its error by the polynomials.
  std::vector<ResistanceFit> lower_degrees;
  /// Fits of tables in which each entry is changed by its error estimate, with random signs.
  std::vector<ResistanceFit> table_errors;
};

/// The perturbed fits of a table; `fit` must be fit_resistance(table). The random signs are the
/// same in each call.
PerturbedFits perturbed_fits(const ResistanceTable& table, const ResistanceFit& fit);

}  // namespace viscontact::swimmer
