#include "viscontact/fitting/robust_least_squares.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <random>

#include "tests/common/failure.hpp"

namespace viscontact::fitting {
namespace {

constexpr Eigen::Index kRows = 60;
const Eigen::Vector3d kTrue(2, -3, 0.5);

struct Line {
  Eigen::MatrixXd matrix{kRows, 3};
  Eigen::VectorXd right_hand_side{kRows};
};

/// A parabola on [0, 1] with Gaussian noise.
Line noisy_parabola(double noise) {
  Line line;
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const double x = static_cast<double>(i) / (kRows - 1);
    line.matrix.row(i) << 1, x, x * x;
    line.right_hand_side(i) = line.matrix.row(i) * kTrue + noise * normal(random);
  }
  return line;
}

class RobustLoss : public ::testing::TestWithParam<lubrication::Loss> {};

TEST_P(RobustLoss, OfGaussianNoiseIsLeastSquaresWithinTheStandardErrors) {
  const auto line = noisy_parabola(0.01);
  const auto plain = solve_least_squares(line.matrix, line.right_hand_side);
  const auto robust = solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam());
  EXPECT_NEAR(robust.scale, 0.01, 0.004);  // a median of 60: 15 %, twice and a half
  for (Eigen::Index j = 0; j < 3; ++j) {
    const double error = std::sqrt(plain.covariance(j, j));
    EXPECT_NEAR(robust.least_squares.coefficients(j), plain.coefficients(j), error) << j;
    // 95 % efficiency: errors a fortieth larger, here within half.
    EXPECT_NEAR(std::sqrt(robust.least_squares.covariance(j, j)) / error, 1, 0.5) << j;
  }
}

TEST_P(RobustLoss, IsNotMovedByOutliersThatMoveLeastSquares) {
  auto line = noisy_parabola(0.01);
  for (const Eigen::Index i : {10, 30, 55}) line.right_hand_side(i) += 5;
  const auto plain = solve_least_squares(line.matrix, line.right_hand_side);
  const auto robust = solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam());
  // Three rows of sixty pull with the force of 1.345 scales at most (Huber): some hundredths; least
  // squares with all of 5.
  EXPECT_LT((robust.least_squares.coefficients - kTrue).norm(), 0.05);
  EXPECT_GT((plain.coefficients - kTrue).norm(), 0.5);
  for (const Eigen::Index i : {10, 30, 55}) {
    EXPECT_LT(robust.row_weights(i), 0.01) << i;
    EXPECT_GT(robust.row_weights(i), 0) << i;
  }
}

TEST_P(RobustLoss, SolvesItsOwnEquations) {
  // At the minimum of sum rho(r/s) the sum of weight * residual * column vanishes: to what the
  // iteration stops at, 1e-9 of the scale.
  auto line = noisy_parabola(0.01);
  line.right_hand_side(20) -= 1;
  const auto robust = solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam());
  const Eigen::VectorXd residual =
      line.matrix * robust.least_squares.coefficients - line.right_hand_side;
  const double c = GetParam() == lubrication::Loss::kHuber ? 1.345 : 2.385;
  Eigen::VectorXd influence(kRows);
  for (Eigen::Index i = 0; i < kRows; ++i) {
    const double z = residual(i) / robust.scale;
    influence(i) =
        GetParam() == lubrication::Loss::kHuber ? std::clamp(z, -c, c) : z / (1 + z * z / (c * c));
  }
  EXPECT_LT((line.matrix.transpose() * influence).cwiseAbs().maxCoeff(), kRows * 1e-8);
}

TEST_P(RobustLoss, OfExactDataIsExact) {
  auto line = noisy_parabola(0);
  const auto robust = solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam());
  EXPECT_LT((robust.least_squares.coefficients - kTrue).norm(),
            1e-12);               // eps times the conditioning
  line.right_hand_side(5) = 100;  // one wrong row among exact ones
  const auto spoiled = solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam());
  EXPECT_LT((spoiled.least_squares.coefficients - kTrue).norm(), 1e-9);
}

TEST_P(RobustLoss, EndsWhenAStopIsRequested) {
  const auto line = noisy_parabola(0.01);
  const std::atomic<bool> flag = true;
  failure(ErrorKind::kInterrupted, [&] {
    solve_robust_least_squares(line.matrix, line.right_hand_side, GetParam(), StopToken(flag));
  });
}

INSTANTIATE_TEST_SUITE_P(Of, RobustLoss,
                         ::testing::Values(lubrication::Loss::kHuber, lubrication::Loss::kCauchy),
                         [](const auto& test) {
                           return std::string(lubrication::to_string(test.param));
                         });

TEST(SquaredLoss, IsLeastSquares) {
  const auto line = noisy_parabola(0.01);
  const auto plain = solve_least_squares(line.matrix, line.right_hand_side);
  const auto same =
      solve_robust_least_squares(line.matrix, line.right_hand_side, lubrication::Loss::kSquared);
  EXPECT_EQ(same.least_squares.coefficients, plain.coefficients);
  EXPECT_EQ(same.row_weights, Eigen::VectorXd::Ones(kRows));
}

TEST(Loss, IsNamedAndReadBack) {
  for (const auto loss :
       {lubrication::Loss::kSquared, lubrication::Loss::kHuber, lubrication::Loss::kCauchy})
    EXPECT_EQ(lubrication::parse_loss(lubrication::to_string(loss)), loss);
  EXPECT_THAT(bad_input([] { lubrication::parse_loss("tukey"); }),
              Names("none", "huber", "cauchy"));
}

}  // namespace
}  // namespace viscontact::fitting
