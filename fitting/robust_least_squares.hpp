// Least squares that are insensitive to a few wrong rows: M-estimates (Huber 1981), with the loss
// functions of Ceres. The residuals and the scale are in the unit of the right-hand side. Fits of
// force tables use it, also without a robust loss, and then the result must stay that of
// least_squares.hpp.
#pragma once

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/least_squares.hpp"
#include "viscontact/lubrication/fit.hpp"

namespace viscontact::fitting {

/// The solution, with the weights that the loss gives to the rows.
struct RobustSolution {
  /// Solution for the rows with their final weights. Its covariance is that of the M-estimate
  /// (Huber 1981, section 7.6), scale^2 sum psi^2/(n - p)/(mean psi')^2 (A^T A)^-1, with psi the
  /// derivative of the loss, n rows and p columns.
  LeastSquaresSolution least_squares;
  /// Weight of each row, > 0 and at most 1; all are 1 with Loss::kSquared.
  Eigen::VectorXd row_weights;
  /// Scale of the residuals A x - b: 1.4826 times the median of their absolute values, corrected
  /// for the degrees of freedom.
  double scale = 0;
};

/// The x that minimises the sum of loss((A x - b)_i/scale) over the rows i, by iteratively
/// reweighted least squares. Arguments and errors are those of solve_least_squares(). Throws
/// Error(kNotConverged) also if the weights do not converge, and Error(kInterrupted) if `stop`,
/// which is asked before each reweighting, requests a stop.
RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side,
                                          lubrication::Loss loss, const StopToken& stop = {});

}  // namespace viscontact::fitting
