// Each step solves a least squares problem, whose weights depend on the residuals of the step
// before.
#include "viscontact/fitting/robust_least_squares.hpp"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact::fitting {
namespace {

/// Free choices of the robust fit.
struct RobustFitTuning {
  // Where each loss leaves the square, in scales. lubrication/fit.hpp repeats both numbers. The
  // standard errors on Gaussian residuals are nearly those of least squares (95 % efficiency).
  static constexpr double kHuber = 1.345, kCauchy = 2.385;
  // In the first 20 steps the scale follows the residuals. Then it is kept, because the sum of the
  // losses falls in every step, so that the iteration converges, only if the scale is constant.
  static constexpr int kStepsWithScale = 20;
  // The limit only ends an iteration that does not converge; robust_least_squares.hpp repeats it.
  static constexpr int kMostSteps = 1000;
  // The iteration ends when no residual changes by more than this fraction of the scale. Any value
  // that is far below the scatter of the residuals (1) and far above rounding errors works.
  static constexpr double kSettled = 1e-9;
  // The least scale over the largest right-hand side, so that rounding errors of an exact fit are
  // no outliers.
  static constexpr double kRoundOff = 1e-14;
};

/// The loss as a function of the square of residual/scale.
std::unique_ptr<ceres::LossFunction> make_loss(lubrication::Loss loss) {
  switch (loss) {
    case lubrication::Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(RobustFitTuning::kHuber);
    case lubrication::Loss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(RobustFitTuning::kCauchy);
    case lubrication::Loss::kSquared:
      break;
  }
  return std::make_unique<ceres::TrivialLoss>();
}

/// RobustSolution::scale of a fit with `columns` coefficients. 1.4826 is the ratio of the standard
/// deviation to the median of |z| for Gaussian z.
double scale_of(const Eigen::VectorXd& residual, Eigen::Index columns) {
  assert(residual.size() > 0);
  std::vector<double> sizes(static_cast<std::size_t>(residual.size()));
  std::ranges::transform(residual, sizes.begin(), [](double r) { return std::abs(r); });
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  const auto rows = static_cast<double>(residual.size());
  const double freedom = std::max(1.0, rows - static_cast<double>(columns));
  return 1.4826 * *middle * std::sqrt(rows / freedom);
}

/// Reweights the rows and solves again, from the coefficients in `solution`, until the residuals no
/// longer change. Sets all members of `solution` but the covariance of the M-estimate.
void iterate(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_hand_side,
             const ceres::LossFunction& loss, const StopToken& stop, RobustSolution& solution) {
  const double round_off = RobustFitTuning::kRoundOff * right_hand_side.cwiseAbs().maxCoeff();
  Eigen::VectorXd residual = matrix * solution.least_squares.coefficients - right_hand_side;
  for (int step = 0; step < RobustFitTuning::kMostSteps; ++step) {
    stop.throw_if_stop_requested();
    if (step < RobustFitTuning::kStepsWithScale)
      solution.scale = std::max(round_off, scale_of(residual, matrix.cols()));
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      std::array<double, 3> rho{};
      const double z = residual(i) / solution.scale;
      loss.Evaluate(z * z, rho.data());
      // rho[1], the derivative of the loss, can underflow to 0, but row_weights are > 0.
      solution.row_weights(i) = std::max(rho[1], std::numeric_limits<double>::min());
    }
    const Eigen::VectorXd root = solution.row_weights.cwiseSqrt();
    solution.least_squares =
        solve_least_squares(root.asDiagonal() * matrix, root.cwiseProduct(right_hand_side));
    const Eigen::VectorXd next = matrix * solution.least_squares.coefficients - right_hand_side;
    const double moved = (next - residual).cwiseAbs().maxCoeff();
    residual = next;
    if (step >= RobustFitTuning::kStepsWithScale &&
        moved <= std::max(round_off, RobustFitTuning::kSettled * solution.scale))
      return;
  }
  throw Error(ErrorKind::kNotConverged, "the robust fit does not converge; try another loss");
}

/// The covariance of the M-estimate (RobustSolution). `plain`, the least squares solution without
/// weights, has the covariance s^2 (A^T A)^-1, in which another variance takes the place of s^2.
Eigen::MatrixXd robust_covariance(const Eigen::MatrixXd& matrix,
                                  const Eigen::VectorXd& right_hand_side,
                                  const LeastSquaresSolution& plain,
                                  const ceres::LossFunction& loss, const RobustSolution& solution) {
  const auto rows = static_cast<double>(matrix.rows());
  const double freedom = rows - static_cast<double>(matrix.cols());
  const double plain_squares = (matrix * plain.coefficients - right_hand_side).squaredNorm();
  if (freedom <= 0 || plain_squares == 0) return plain.covariance;
  const Eigen::VectorXd residual =
      (matrix * solution.least_squares.coefficients - right_hand_side) / solution.scale;
  double psi_squares = 0, slopes = 0;
  for (const double z : residual) {
    std::array<double, 3> rho{};
    loss.Evaluate(z * z, rho.data());
    psi_squares += rho[1] * z * rho[1] * z;
    slopes += rho[1] + 2 * z * z * rho[2];
  }
  const double variance =
      solution.scale * solution.scale * psi_squares / freedom / std::pow(slopes / rows, 2);
  return plain.covariance * (variance / (plain_squares / freedom));
}

}  // namespace

RobustSolution solve_robust_least_squares(const Eigen::MatrixXd& matrix,
                                          const Eigen::VectorXd& right_hand_side,
                                          lubrication::Loss loss, const StopToken& stop) {
  RobustSolution solution;
  solution.least_squares = solve_least_squares(matrix, right_hand_side);
  solution.row_weights = Eigen::VectorXd::Ones(matrix.rows());
  solution.scale =
      scale_of(matrix * solution.least_squares.coefficients - right_hand_side, matrix.cols());
  if (loss == lubrication::Loss::kSquared) return solution;
  // The sum of Huber's losses has one minimum, but that of Cauchy's losses may have several. The
  // iteration with Cauchy's loss therefore starts from the solution with Huber's loss, which fits
  // the majority of the rows.
  const auto function = make_loss(loss);
  const auto plain = solution.least_squares;
  iterate(matrix, right_hand_side, *make_loss(lubrication::Loss::kHuber), stop, solution);
  if (loss != lubrication::Loss::kHuber)
    iterate(matrix, right_hand_side, *function, stop, solution);
  solution.least_squares.covariance =
      robust_covariance(matrix, right_hand_side, plain, *function, solution);
  return solution;
}

}  // namespace viscontact::fitting
