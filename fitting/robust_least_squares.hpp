// Linear least squares in which a few wrong rows have little effect: M-estimates (Huber 1981).
#pragma once

#include "viscontact/common/stop_token.hpp"
#include "viscontact/fitting/least_squares.hpp"
#include "viscontact/lubrication/fit.hpp"

namespace viscontact::fitting {

struct RobustSolution {
  /// Solution for the rows with their final weights. With a robust loss its covariance is that of
  /// the M-estimate (Huber 1981, section 7.6), scale^2 sum psi^2/(n - p)/(mean psi')^2 (A^T A)^-1,
  /// where psi is the derivative of the loss at residual/scale, sum and mean are over the rows, and
  /// A has n rows and p columns.
  LeastSquaresSolution least_squares;
  /// Weight of each row [1], > 0 and at most 1; all are 1 with Loss::kSquared.
  Eigen::VectorXd row_weights;
  /// Scale of the residuals A x - b: 1.4826 sqrt(n/max(1, n - p)) times the median of their
  /// absolute values, which estimates the standard deviation of Gaussian residuals.
  double scale = 0;
};

/// The x that minimises the sum of loss((A x - b)_i/scale) over the rows i, with A = `matrix` and b
/// = `right_hand_side`, by iteratively reweighted least squares. A has at least as many rows as
/// columns. Throws the errors of solve_least_squares(), Error(kNotConverged) if 1000 reweightings
/// do not suffice, and Error(kInterrupted) if `stop` requests a stop, which is checked before each
/// reweighting. With Loss::kSquared the result is that of solve_least_squares(), to the last bit.
RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side,
                                          lubrication::Loss loss, const StopToken& stop = {});

}  // namespace viscontact::fitting
