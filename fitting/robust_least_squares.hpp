// Least squares that a few wrong rows do not spoil: M-estimates by Ceres's loss functions.
#pragma once

#include "viscontact/fitting/least_squares.hpp"
#include "viscontact/lubrication/fit.hpp"

namespace viscontact {

struct RobustSolution {
  /// Of the rows weighted as the loss weighs them in the end; covariance of the M-estimate, scale^2 sum psi^2 / (n - p) / (mean psi')^2 (A^T A)^-1 (Huber
  /// 1981, section 7.6), psi the loss's derivative.
  LeastSquaresSolution least_squares;
  Eigen::VectorXd row_weights;  ///< in ]0, 1]: 1 for every row with Loss::kSquared
  double scale =
      0;  ///< of the residuals A x - b: 1.4826 times their median absolute value, corrected for the freedoms used
};

/// The x that minimises the sum of loss((A x - b)_i / scale) over x, by iteratively reweighted least squares; arguments and errors as
/// solve_least_squares. Throws Error(kNotConverged) too when the weights do not settle.
RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side, Loss loss);

}  // namespace viscontact
