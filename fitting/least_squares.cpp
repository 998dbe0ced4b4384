// The columns of A are divided by powers of two, Ceres solves the scaled problem, and the solution
// is refined in extended precision.
#include "viscontact/fitting/least_squares.hpp"

#include <ceres/ceres.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/matrices/decompositions.hpp"

namespace viscontact::fitting {
namespace {

/// Free choices of the linear fit.
struct LeastSquaresTuning {
  // Each step of the refinement gains about 16 - log10(condition number) digits. Even at the
  // condition number 1e12 four steps gain all 16 digits of a double. More steps only cost time.
  static constexpr int kRefinements = 4;
  // The problem is linear. Without damping the first step of Ceres therefore reaches the solution,
  // and the next steps only reduce its rounding errors. The extreme values turn off the damping and
  // the tests that could stop the iteration earlier.
  static constexpr double kTrustRegion = 1e32, kDamping = 1e-32;
  static constexpr double kTolerance = 1e-16, kGradientTolerance = 1e-300;
  // Rounding errors can make the predicted gain of a later step negative. Ceres rejects such a step
  // and keeps the solution. The limit 20, larger than the number of steps, makes it no failure.
  static constexpr int kSteps = 4, kMostInvalidSteps = 20;
  // Turns off Ceres' own test of the rank, which condition_number_of() replaces.
  static constexpr double kReciprocalCondition = 1e-32;
};

using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The residuals A x - b as one block of Ceres, whose Jacobian is A. Both references must outlive
/// the object.
class LinearResiduals : public ceres::CostFunction {
 public:
  LinearResiduals(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_hand_side)
      : matrix_(matrix), right_hand_side_(right_hand_side) {
    set_num_residuals(static_cast<int>(matrix.rows()));
    mutable_parameter_block_sizes()->push_back(static_cast<int>(matrix.cols()));
  }

  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    const Eigen::Map<const Eigen::VectorXd> x(parameters[0], matrix_.cols());
    Eigen::Map<Eigen::VectorXd>(residuals, matrix_.rows()) = matrix_ * x - right_hand_side_;
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<RowMajorMatrix>(jacobians[0], matrix_.rows(), matrix_.cols()) = matrix_;
    }
    return true;
  }

 private:
  const Eigen::MatrixXd& matrix_;
  const Eigen::VectorXd& right_hand_side_;
};

/// For each column the largest power of two that is not larger than its length, because a division
/// by it rounds no entry; 1 for a column of zeros.
Eigen::VectorXd binary_scale(const Eigen::MatrixXd& matrix) {
  return matrix.colwise().norm().unaryExpr(
      [](double norm) { return norm > 0 ? std::exp2(std::floor(std::log2(norm))) : 1.0; });
}

/// Iterative refinement of the solution x and the residual r together (Bjorck 1967): solves r + A
/// x = b, A^T r = 0 with sums in extended precision. Refinement of x alone would lose digits if r
/// is not small. `solution` stays unchanged if a refined entry is not finite.
void refine(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right_hand_side,
            Eigen::VectorXd& solution) {
  using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Eigen::Index columns = matrix.cols();
  const auto long_matrix = matrix.cast<long double>();
  const LongVector b = right_hand_side.cast<long double>();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(matrix);
  const auto upper = qr.matrixQR().topRows(columns).triangularView<Eigen::Upper>();
  LongVector x = solution.cast<long double>();
  LongVector residual = b - long_matrix * x;
  for (int step = 0; step < LeastSquaresTuning::kRefinements; ++step) {
    const Eigen::VectorXd f = (b - residual - long_matrix * x).cast<double>();
    const Eigen::VectorXd g = (-(long_matrix.transpose() * residual)).cast<double>();
    const Eigen::VectorXd h = upper.transpose().solve(g);
    Eigen::VectorXd d = transposed_q_times(qr, f);
    x += upper.solve(d.head(columns) - h).cast<long double>();
    d.head(columns) = h;
    const Eigen::VectorXd correction = q_times(qr, d);
    residual += correction.cast<long double>();
  }
  const Eigen::VectorXd refined = x.cast<double>();
  if (refined.allFinite()) solution = refined;
}

/// Throws Error(kNotConverged) if the columns are linearly dependent in double precision.
double condition_number_of(const Eigen::MatrixXd& matrix) {
  const Eigen::VectorXd length =
      matrix.colwise().norm().cwiseMax(std::numeric_limits<double>::min());
  const Eigen::VectorXd singular =
      Eigen::JacobiSVD<Eigen::MatrixXd>(matrix * length.cwiseInverse().asDiagonal())
          .singularValues();
  const double smallest = singular(singular.size() - 1);
  // The usual bound for a numerical rank: number of rows times the machine epsilon.
  if (!(smallest >
        singular(0) * static_cast<double>(matrix.rows()) * std::numeric_limits<double>::epsilon()))
    throw Error(ErrorKind::kNotConverged,
                "the fit's terms cannot be told apart on this table; give more or wider spread "
                "gaps, or fewer terms");
  return singular(0) / smallest;
}

/// The covariance of `x`, the parameters of `problem`, for residuals of variance 1.
RowMajorMatrix unit_covariance(ceres::Problem& problem, const Eigen::VectorXd& x) {
  ceres::Covariance::Options options;
  options.algorithm_type = ceres::DENSE_SVD;
  options.min_reciprocal_condition_number = LeastSquaresTuning::kReciprocalCondition;
  ceres::Covariance covariance(options);
  RowMajorMatrix unit(x.size(), x.size());
  const std::vector<std::pair<const double*, const double*>> blocks = {{x.data(), x.data()}};
  if (!covariance.Compute(blocks, &problem) ||
      !covariance.GetCovarianceBlock(x.data(), x.data(), unit.data()))
    throw Error(ErrorKind::kNotConverged, "the covariance of the fit cannot be computed");
  return unit;
}

}  // namespace

LeastSquaresSolution solve_least_squares(const Eigen::MatrixXd& matrix,
                                         const Eigen::VectorXd& right_hand_side) {
  assert(matrix.rows() >= matrix.cols() && matrix.cols() > 0 &&
         matrix.rows() == right_hand_side.size());
  if (!matrix.allFinite() || !right_hand_side.allFinite())
    throw Error(ErrorKind::kBadInput,
                "a gap or a force is too small or too large: a term of the fit overflows");
  // Ceres starts at x = 0, where the cost is |b|^2/2. If this is infinite, Ceres 2.2 fails, and
  // Ceres 2.1 continues to coefficients that are not finite.
  if (!std::isfinite(right_hand_side.squaredNorm()))
    throw Error(ErrorKind::kBadInput,
                "the forces are too large or too different to be fitted in double precision");
  const Eigen::VectorXd scale = binary_scale(matrix);
  const Eigen::MatrixXd scaled = matrix * scale.cwiseInverse().asDiagonal();

  LeastSquaresSolution solution;
  solution.condition_number = condition_number_of(scaled);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(matrix.cols());
  ceres::Problem problem;
  problem.AddResidualBlock(new LinearResiduals(scaled, right_hand_side), nullptr, x.data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.initial_trust_region_radius = LeastSquaresTuning::kTrustRegion;
  options.max_trust_region_radius = LeastSquaresTuning::kTrustRegion;
  options.min_lm_diagonal = LeastSquaresTuning::kDamping;
  options.jacobi_scaling = false;  // the columns are scaled already
  options.max_num_iterations = LeastSquaresTuning::kSteps;
  options.max_num_consecutive_invalid_steps = LeastSquaresTuning::kMostInvalidSteps;
  options.function_tolerance = LeastSquaresTuning::kTolerance;
  options.parameter_tolerance = LeastSquaresTuning::kTolerance;
  options.gradient_tolerance = LeastSquaresTuning::kGradientTolerance;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable() || !x.allFinite())
    throw Error(ErrorKind::kNotConverged, "the least-squares fit failed: " + summary.message);
  refine(scaled, right_hand_side, x);
  solution.coefficients = x.cwiseQuotient(scale);

  const Eigen::Index degrees_of_freedom = matrix.rows() - matrix.cols();
  solution.covariance = Eigen::MatrixXd::Zero(matrix.cols(), matrix.cols());
  if (degrees_of_freedom > 0) {
    const double variance =
        (scaled * x - right_hand_side).squaredNorm() / static_cast<double>(degrees_of_freedom);
    solution.covariance = variance * scale.cwiseInverse().asDiagonal() *
                          unit_covariance(problem, x) * scale.cwiseInverse().asDiagonal();
  }
  return solution;
}

}  // namespace viscontact::fitting
