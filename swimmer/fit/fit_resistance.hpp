// Fits the resistance matrices of spheres on a line, given in a table, by a function of the gaps
// (ResistanceFit), and makes perturbed fits, from which the results of a swimmer get their error
// estimates. Lengths, masses and times are in the units of the table. A table without all
// combinations of its gaps, or with a matrix that is not positive definite, throws
// Error(kBadInput). swimmer/job and python/ call it. A change must keep that the fit meets every
// row of the table.
#pragma once

#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// The fit that interpolates all rows of the table. The number of its lubrication terms is the one
/// with the smallest error of a row that is predicted from the others (largest_left_one_out_error),
/// among those for which each matrix minus its lubrication is positive definite. Throws
/// Error(kBadInput) if the rows are not all combinations of at least three values of each gap, each
/// combination once, or if a matrix is not positive definite. The checksum and the versions of the
/// result are empty.
ResistanceFit fit_resistance(const ResistanceTable& table);

/// Fits with which a result is computed again. Its changes are estimates of its errors.
struct PerturbedFits {
  /// For each gap, in the order of the spheres, the least-squares fit whose polynomials have one
  /// degree less in this gap. A result changes by about the error that it has because its
  /// polynomials have a finite degree.
  std::vector<ResistanceFit> lower_degrees;
  /// Fits of tables in which each entry is changed by its error estimate, with random signs; at
  /// most 16, which give a root mean square to about a fifth.
  std::vector<ResistanceFit> table_errors;
};

/// The perturbed fits of a table; `fit` must be fit_resistance(table) (not checked). The random
/// signs are the same in each call. A fit of `table_errors` is left out if its table has a matrix
/// that is not positive definite.
PerturbedFits perturbed_fits(const ResistanceTable& table, const ResistanceFit& fit);

}  // namespace viscontact::swimmer
