// Linear least squares, min |A x - b|, with covariance of x and condition number of A.
#pragma once

#include <Eigen/Core>

namespace viscontact::fitting {

struct LeastSquaresSolution {
  /// x. The unit of an entry is the unit of b divided by the unit of the column of A.
  Eigen::VectorXd coefficients;
  /// Covariance matrix of x: s^2 (A^T A)^-1 with s^2 = |A x - b|^2/(rows - columns), the variance
  /// of a residual. All entries are 0 if rows == columns.
  Eigen::MatrixXd covariance;
  /// Condition number of A with its columns scaled to length 1.
  double condition_number = 0;
};

/// The x that minimises |A x - b|_2, with A = `matrix` and b = `right_hand_side`. A has at least as
/// many rows as columns. Throws Error(kBadInput) if an entry is not finite or if |b|^2 overflows,
/// and Error(kNotConverged) if the columns are linearly dependent in double precision or if Ceres
/// fails.
LeastSquaresSolution solve_least_squares(const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_hand_side);

}  // namespace viscontact::fitting
