// Linear least squares by Ceres: columns scaled, solution refined, covariance, condition number.
#pragma once

#include <Eigen/Core>

namespace viscontact {

struct LeastSquaresSolution {
  Eigen::VectorXd coefficients;
  /// Of the coefficients, from the residuals' own variance s^2 = |A x - b|^2 / (rows - columns);
  /// zero where rows == columns.
  Eigen::MatrixXd covariance;
  double condition_number = 0;  ///< of A with its columns scaled to length 1, >= 1
};

/// The x that minimises |A x - b|_2; A is rows x columns, rows >= columns, every entry finite.
/// Throws Error(kBadInput) when an entry is not finite or |b|^2 overflows, and
/// Error(kNotConverged) when the columns are linearly dependent to working precision, or
/// Ceres fails.
LeastSquaresSolution solve_least_squares(const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_hand_side);

}  // namespace viscontact
