// Linear least squares, min |A x - b|, with covariance of x and condition number of A. Numbers have
// any units. Numbers that are not finite throw Error(kBadInput); linearly dependent columns throw
// Error(kNotConverged). Sizes are only asserted. The method may be changed. Used by
// robust_least_squares.hpp, and so by every fit of a table. A change must keep the number of
// correct digits that tests/fitting/ demands for the reference problems of NIST.
#pragma once

#include <Eigen/Core>

namespace viscontact::fitting {

/// The solution x of a least squares problem, with its uncertainty.
struct LeastSquaresSolution {
  /// x, with an entry for each column of A. The unit of an entry is the unit of b divided by the
  /// unit of the column.
  Eigen::VectorXd coefficients;
  /// Covariance matrix of x, with a row and a column for each entry of x: s^2 (A^T A)^-1 with s^2 =
  /// |A x - b|^2/(rows - columns), the variance of a residual. Its unit is that of a product of two
  /// entries of x. All entries are 0 if rows == columns.
  Eigen::MatrixXd covariance;
  /// Condition number of A with its columns scaled to length 1, >= 1.
  double condition_number = 0;
};

/// The x that minimises |A x - b|_2, with A = `matrix` and b = `right_hand_side`. A has at least
/// one column and at least as many rows as columns, and b an entry for each row (asserted). Throws
/// Error(kBadInput) if an entry is not finite or if |b|^2 overflows, and Error(kNotConverged) if
/// the columns are linearly dependent in double precision or if Ceres fails.
LeastSquaresSolution solve_least_squares(const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_hand_side);

}  // namespace viscontact::fitting
