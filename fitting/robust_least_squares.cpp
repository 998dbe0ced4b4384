// Iteratively reweighted least squares with the losses of Huber and Cauchy. Residuals are in the
// unit of the right-hand side. The constants 1.345 and 2.385 are those of Loss in
// lubrication/fit.hpp. Weights that do not settle are an Error(kNotConverged). A change must keep
// that without a robust loss the result is that of least_squares.cpp.
#include "viscontact/fitting/robust_least_squares.hpp"

#include <ceres/loss_function.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include "viscontact/common/error.hpp"

namespace viscontact::fitting {
namespace {

std::unique_ptr<ceres::LossFunction> make_loss(lubrication::Loss loss) {
  switch (loss) {
    case lubrication::Loss::kHuber:
      return std::make_unique<ceres::HuberLoss>(1.345);
    case lubrication::Loss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(2.385);
    case lubrication::Loss::kSquared:
      break;
  }
  return std::make_unique<ceres::TrivialLoss>();
}

/// The scale of the residuals. The factor 1.4826 makes the median of |z| the standard deviation of
/// Gaussian z.
double scale_of(const Eigen::VectorXd& residual, Eigen::Index columns) {
  std::vector<double> sizes(static_cast<std::size_t>(residual.size()));
  std::ranges::transform(residual, sizes.begin(), [](double r) { return std::abs(r); });
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  const auto rows = static_cast<double>(residual.size());
  const double freedom = std::max(1.0, rows - static_cast<double>(columns));
  return 1.4826 * *middle * std::sqrt(rows / freedom);
}

/// Reweights the rows, starting from `solution`, until the residuals do not change.
void iterate(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_hand_side,
             const ceres::LossFunction& loss, const StopToken& stop, RobustSolution& solution) {
  // At first the scale is computed again in each step. Then it is constant, because only with a
  // constant scale the sum of losses falls in every step.
  constexpr int kStepsWithScale = 20;
  constexpr int kMostSteps = 1000;
  // The iteration ends when no residual changes by more than this fraction of the scale, which is
  // far smaller than any difference that matters.
  constexpr double kSettled = 1e-9;
  // Residuals as small as round-off must not be taken for outliers.
  const double round_off = 1e-14 * right_hand_side.cwiseAbs().maxCoeff();
  Eigen::VectorXd residual = matrix * solution.least_squares.coefficients - right_hand_side;
  for (int step = 0; step < kMostSteps; ++step) {
    stop.throw_if_stop_requested();
    if (step < kStepsWithScale)
      solution.scale = std::max(round_off, scale_of(residual, matrix.cols()));
    for (Eigen::Index i = 0; i < residual.size(); ++i) {
      std::array<double, 3> rho{};
      const double z = residual(i) / solution.scale;
      loss.Evaluate(z * z, rho.data());
      // A row with an extreme residual keeps a tiny weight, so that no division by zero follows.
      solution.row_weights(i) = std::max(rho[1], std::numeric_limits<double>::min());
    }
    const Eigen::VectorXd root = solution.row_weights.cwiseSqrt();
    solution.least_squares =
        solve_least_squares(root.asDiagonal() * matrix, root.cwiseProduct(right_hand_side));
    const Eigen::VectorXd next = matrix * solution.least_squares.coefficients - right_hand_side;
    const double moved = (next - residual).cwiseAbs().maxCoeff();
    residual = next;
    if (step >= kStepsWithScale && moved <= std::max(round_off, kSettled * solution.scale)) return;
  }
  throw Error(ErrorKind::kNotConverged, "the robust fit does not converge; try another loss");
}

/// The covariance of the M-estimate, from that of least squares, which is s^2 (A^T A)^-1 with
/// s^2 = |r|^2/(n - p).
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
  // The sum of Huber's losses has one minimum, that of Cauchy's losses may have several. With
  // Cauchy's loss the iteration starts from Huber's solution, near which most rows agree.
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
