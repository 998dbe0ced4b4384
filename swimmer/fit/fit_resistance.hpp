// Fits the resistance matrices of spheres on a line by a function of their gaps (docs/physics.md
// (7.2)).
#pragma once

#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// The fit that interpolates all rows of the table, which has at least two radii. Of 0 to 3
/// lubrication terms it has the number with the smallest ResistanceFit::largest_left_one_out_error,
/// among those for which each matrix minus its lubrication is positive definite. Throws
/// Error(kBadInput) if the rows are not all combinations of at least three values of each gap, each
/// combination once, or if a matrix is not positive definite. The members `table_sha256` and
/// `versions` of the result are empty.
ResistanceFit fit_resistance(const ResistanceTable& table);

/// Fits with which a result of a swimmer, such as its displacement, is computed again. The changes
/// of the result are estimates of its errors.
struct PerturbedFits {
  /// For each gap, in the order of the spheres, the least-squares fit whose polynomials have one
  /// degree less in this gap. With this fit a result changes by about the error that the finite
  /// degree of the polynomials causes.
  std::vector<ResistanceFit> lower_degrees;
  /// At most 16 fits of tables in which each entry is changed by its error estimate, with random
  /// signs. 16 fits give the root mean square of the changes of a result to about a fifth.
  std::vector<ResistanceFit> table_errors;
};

/// The perturbed fits of a table for `fit` = fit_resistance(table). The random signs are the same
/// in each call, so that error estimates can be repeated. A fit of `table_errors` is left out if
/// its changed table has a matrix that is not positive definite after the lubrication is
/// subtracted.
PerturbedFits perturbed_fits(const ResistanceTable& table, const ResistanceFit& fit);

}  // namespace viscontact::swimmer
