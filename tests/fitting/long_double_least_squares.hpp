// Least squares in long double, with which the solver under test is compared. It shares no code
// with that solver. Numbers have no units.
#pragma once

#include <Eigen/Core>

namespace viscontact::fitting {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

struct LongSolution {
  LongVector coefficients;
  /// s^2 (A^T A)^-1 with s^2 = |A x - b|^2 / (rows - columns), for the matrix A, the solution x and
  /// the right-hand side b.
  LongMatrix covariance;
};

/// Solves by the QR decomposition of Gram and Schmidt. Each column is orthogonalised twice, which
/// is enough for full precision (Giraud & Langou 2005).
inline LongSolution long_double_least_squares(const Eigen::MatrixXd& matrix,
                                              const Eigen::VectorXd& right_hand_side) {
  const LongMatrix a = matrix.cast<long double>();
  const LongVector b = right_hand_side.cast<long double>();
  LongMatrix q = a;
  LongMatrix r = LongMatrix::Zero(a.cols(), a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (int pass = 0; pass < 2; ++pass)
      for (Eigen::Index i = 0; i < j; ++i) {
        const long double part = q.col(i).dot(q.col(j));
        r(i, j) += part;
        q.col(j) -= part * q.col(i);
      }
    r(j, j) = q.col(j).norm();
    q.col(j) /= r(j, j);
  }
  // Back substitution, for the solution and for R^-1.
  const auto solve = [&r](LongVector x) {
    for (Eigen::Index i = x.size(); i-- > 0;) {
      for (Eigen::Index j = i + 1; j < x.size(); ++j) x(i) -= r(i, j) * x(j);
      x(i) /= r(i, i);
    }
    return x;
  };
  LongSolution solution;
  solution.coefficients = solve(q.transpose() * b);
  LongMatrix inverse(a.cols(), a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) inverse.col(j) = solve(LongVector::Unit(a.cols(), j));
  const long double variance =
      (a * solution.coefficients - b).squaredNorm() / static_cast<long double>(a.rows() - a.cols());
  solution.covariance = variance * inverse * inverse.transpose();
  return solution;
}

}  // namespace viscontact::fitting
