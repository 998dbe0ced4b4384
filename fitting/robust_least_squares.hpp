// Least squares that are insensitive to a few wrong rows: M-estimates (Huber 1981), with the loss
// functions of Ceres.
#pragma once

#include "viscontact/fitting/least_squares.hpp"
#include "viscontact/lubrication/fit/fit.hpp"

namespace viscontact::fitting {

/// The solution, with what the loss made of the rows.
struct RobustSolution {
  /// Solution for the rows with their final weights. Its covariance is that of the M-estimate
  /// (Huber 1981, section 7.6), scale^2 sum psi^2/(n - p)/(mean psi')^2 (A^T A)^-1, with psi the
  /// derivative of the loss, n rows and p columns.
  LeastSquaresSolution least_squares;
  /// In ]0, 1]; all 1 with Loss::kSquared.
  Eigen::VectorXd row_weights;
  /// Scale of the residuals A x - b: 1.4826 times the median of their absolute values, corrected
  /// for the degrees of freedom.
  double scale = 0;
};

/// The x that minimises the sum of loss((A x - b)_i/scale), by iteratively reweighted least
/// squares. Arguments and errors are those of solve_least_squares(). Throws Error(kNotConverged)
/// also if the weights do not converge.
RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side,
                                          lubrication::Loss loss);

}  // namespace viscontact::fitting
