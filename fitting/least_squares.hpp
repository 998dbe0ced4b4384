// Linear least squares by Ceres, with scaled columns, refined solution, covariance and condition
// number. Numbers have any units. Every fit uses it; a change must keep the digits of the NIST
// reference problems in the tests.
#pragma once

#include <Eigen/Core>

namespace viscontact::fitting {

/// The solution x of a least squares problem, with its uncertainty.
struct LeastSquaresSolution {
  Eigen::VectorXd coefficients;  ///< x; the unit of x_i is that of b over that of column i of A
  /// Covariance of the coefficients, with the variance s^2 = |A x - b|^2/(rows - columns) of the
  /// residuals; zero if rows == columns.
  Eigen::MatrixXd covariance;
  /// Condition number of A with its columns scaled to length 1, >= 1.
  double condition_number = 0;
};

/// The x that minimises |A x - b|_2, with A = `matrix`, which must have at least as many rows as
/// columns, and b = `right_hand_side`. Throws
/// Error(kBadInput) if an entry is not finite or if |b|^2 overflows, and Error(kNotConverged) if
/// the columns are linearly dependent to working precision or if Ceres fails.
LeastSquaresSolution solve_least_squares(const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_hand_side);

}  // namespace viscontact::fitting
