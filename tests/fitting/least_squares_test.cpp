#include "viscontact/fitting/least_squares.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <random>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/fitting/long_double_least_squares.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {
namespace {

/// The columns of a basis at gaps, each row weighted by its gap: as a relative fit does it near
/// contact.
Eigen::MatrixXd columns_of(std::string_view basis, const std::vector<double>& gaps) {
  const auto& terms = lubrication::find_basis(basis).terms;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(gaps.size()),
                         static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const double gap = gaps[static_cast<std::size_t>(i)];
      matrix(i, j) = gap * terms[static_cast<std::size_t>(j)].value(gap);
    }
  return matrix;
}

Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

/// |x - y| over |y|, each coefficient counted by the length of its column: what the conditioning of
/// the scaled problem bounds.
double scaled_distance(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& x,
                       const Eigen::VectorXd& y) {
  const Eigen::VectorXd scale = matrix.colwise().norm();
  return (x - y).cwiseProduct(scale).norm() / y.cwiseProduct(scale).norm();
}

class OnBasis : public ::testing::TestWithParam<std::string> {};

TEST_P(OnBasis, RecoversPlantedCoefficients) {
  std::mt19937_64 random(1);
  const auto matrix = columns_of(GetParam(), fifty_gaps());
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd planted = random_matrix(matrix.cols(), 1, random);
    const auto solution = solve_least_squares(matrix, matrix * planted);
    // The right-hand side itself is rounded: eps times the conditioning comes back. 1e-12 leaves
    // room for 50 rows.
    EXPECT_LT(scaled_distance(matrix, solution.coefficients, planted),
              1e-12 * solution.condition_number);
  }
}

TEST_P(OnBasis, AgreesWithAnIndependentQrInLongDouble) {
  std::mt19937_64 random(2);
  const auto matrix = columns_of(GetParam(), fifty_gaps());
  for (const double noise : {1e-6, 1e-2}) {
    const Eigen::VectorXd right_hand_side = matrix * Eigen::VectorXd::Ones(matrix.cols()) +
                                            noise * random_matrix(matrix.rows(), 1, random);
    const auto solution = solve_least_squares(matrix, right_hand_side);
    const auto oracle = long_double_least_squares(matrix, right_hand_side);
    // A residual that does not vanish counts with the square of the conditioning (Bjorck 1996,
    // theorem 1.4.6).
    const double condition = solution.condition_number;
    EXPECT_LT(scaled_distance(matrix, solution.coefficients, oracle.coefficients.cast<double>()),
              1e-14 * (condition + noise * condition * condition));
    const Eigen::VectorXd scale = matrix.colwise().norm();
    const Eigen::MatrixXd difference = scale.asDiagonal() *
                                       (solution.covariance - oracle.covariance.cast<double>()) *
                                       scale.asDiagonal();
    const Eigen::MatrixXd size =
        scale.asDiagonal() * oracle.covariance.cast<double>() * scale.asDiagonal();
    // (A^T A)^-1 is known to eps times the conditioning, s^2 to eps |b| over the residual.
    EXPECT_LT(difference.norm(), 1e-13 * (condition + 1 / noise) * size.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(LeastSquares, OnBasis, ::testing::Values("lecture", "asymptotic"),
                         [](const auto& tested) { return tested.param; });

TEST(LeastSquares, DoesNotMindColumnsOfDifferentMagnitudes) {
  std::mt19937_64 random(3);
  Eigen::MatrixXd matrix = random_matrix(30, 4, random);
  const Eigen::VectorXd right_hand_side = random_matrix(30, 1, random);
  const auto plain = solve_least_squares(matrix, right_hand_side);
  const Eigen::Vector4d scale(std::ldexp(1.0, 200), std::ldexp(1.0, -200), 1,
                              std::ldexp(1.0, 50));  // exact powers of two
  const auto scaled = solve_least_squares(matrix * scale.asDiagonal(), right_hand_side);
  EXPECT_DOUBLE_EQ(scaled.condition_number, plain.condition_number);
  for (Eigen::Index i = 0; i < 4; ++i) {
    // Column norms of 2^200 and their squares are exact powers apart: nothing but a few roundings
    // may differ.
    EXPECT_NEAR(scaled.coefficients(i) * scale(i), plain.coefficients(i),
                1e-14 * plain.coefficients.norm());
    EXPECT_NEAR(std::sqrt(scaled.covariance(i, i)) * scale(i), std::sqrt(plain.covariance(i, i)),
                1e-13 * std::sqrt(plain.covariance(i, i)));
  }
}

TEST(LeastSquares, ReportsTheConditionNumberOfTheScaledColumns) {
  // Two unit vectors at angle t: singular values sqrt(1 +- cos t), condition cot(t/2).
  const double angle = 1e-3;
  Eigen::MatrixXd matrix(3, 2);
  matrix << 1, 7 * std::cos(angle), 0, 7 * std::sin(angle), 0, 0;
  // The small singular value is known to eps over itself.
  EXPECT_NEAR(solve_least_squares(matrix, Eigen::Vector3d(1, 2, 3)).condition_number,
              1 / std::tan(angle / 2), 1e-9);
  EXPECT_NEAR(solve_least_squares(Eigen::MatrixXd::Identity(3, 2), Eigen::Vector3d(1, 2, 3))
                  .condition_number,
              1, 1e-15);
}

TEST(LeastSquares, OfOneColumnOfOnesIsTheMeanWithItsStandardError) {
  const Eigen::VectorXd values = Eigen::Vector4d(1, 2, 4, 5);
  const auto solution = solve_least_squares(Eigen::MatrixXd::Ones(4, 1), values);
  EXPECT_DOUBLE_EQ(solution.coefficients(0), 3);
  EXPECT_DOUBLE_EQ(solution.covariance(0, 0), (4.0 + 1 + 1 + 4) / 3 / 4);  // s^2 / n
}

TEST(LeastSquares, WithoutSpareRowsInterpolatesAndHasNoCovariance) {
  std::mt19937_64 random(4);
  const Eigen::MatrixXd matrix = random_matrix(4, 4, random);
  const Eigen::VectorXd planted = random_matrix(4, 1, random);
  const auto solution = solve_least_squares(matrix, matrix * planted);
  EXPECT_LT(scaled_distance(matrix, solution.coefficients, planted),
            1e-14 * solution.condition_number);
  EXPECT_EQ(solution.covariance, Eigen::MatrixXd::Zero(4, 4));
}

TEST(LeastSquares, RefusesDependentColumns) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 200; ++trial) {
    Eigen::MatrixXd matrix = random_matrix(40, 5, random);
    matrix.col(4) = matrix.col(0) - 3 * matrix.col(1) + 0.1 * matrix.col(2);  // but for rounding
    failure(ErrorKind::kNotConverged,
            [&] { solve_least_squares(matrix, Eigen::VectorXd::Ones(40)); });
  }
}

TEST(LeastSquares, RefusesAColumnOfZeros) {
  std::mt19937_64 random(6);
  Eigen::MatrixXd matrix = random_matrix(10, 3, random);
  matrix.col(1).setZero();
  EXPECT_THAT(failure(ErrorKind::kNotConverged,
                      [&] { solve_least_squares(matrix, Eigen::VectorXd::Ones(10)); }),
              Names("apart"));
}

}  // namespace
}  // namespace viscontact::fitting
