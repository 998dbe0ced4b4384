// Certified data of the NIST Statistical Reference Datasets (linear regression, Wampler 1 to 5: polynomials of degree 5 on x = 0..20,
// higher level of difficulty), https://www.itl.nist.gov/div898/strd/lls/lls.shtml.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "fitting/least_squares.hpp"

namespace viscontact {
namespace {

constexpr int kRows = 21;
constexpr int kColumns = 6;

Eigen::MatrixXd powers() {
  Eigen::MatrixXd matrix(kRows, kColumns);
  for (int i = 0; i < kRows; ++i)
    for (int j = 0; j < kColumns; ++j) matrix(i, j) = std::pow(i, j);
  return matrix;
}

/// The perturbation of Wampler 3, which is orthogonal to every polynomial of degree 5: the coefficients stay 1.
Eigen::VectorXd perturbation() {
  Eigen::VectorXd values(kRows);
  values << 759, -2048, 2048, -2048, 2523, -2048, 2048, -2048, 1838, -2048, 2048, -2048, 1838,
      -2048, 2048, -2048, 2523, -2048, 2048, -2048, 759;
  return values;
}

/// The standard deviations that NIST certifies for Wampler 3; 100 times that for Wampler 4, 10000 times for Wampler 5.
constexpr std::array<double, kColumns> kCertifiedDeviations = {2152.32624678170, 2363.55173469681,
                                                               779.343524331583, 101.475507550350,
                                                               5.64566512170752, 0.112324854679312};

TEST(NistWampler, OneIsRecovered) {
  const auto matrix = powers();
  const auto solution = solve_least_squares(matrix, matrix * Eigen::VectorXd::Ones(kColumns));
  for (int j = 0; j < kColumns; ++j) {
    // In units of the term's share at x = 20; the conditioning of the scaled columns is 2e3 or so, times eps.
    EXPECT_NEAR(solution.coefficients(j), 1,
                1e-15 * solution.condition_number * std::pow(20.0, 5 - j));
    EXPECT_LT(std::sqrt(solution.covariance(j, j)),
              1e-15 * solution.condition_number * std::pow(20.0, 5 - j))
        << "certified: 0";
  }
}

TEST(NistWampler, TwoIsRecovered) {
  Eigen::VectorXd certified(kColumns);
  certified << 1, 0.1, 0.01, 0.001, 0.0001, 0.00001;
  const auto matrix = powers();
  const auto solution = solve_least_squares(matrix, matrix * certified);
  for (int j = 0; j < kColumns; ++j)
    EXPECT_NEAR(solution.coefficients(j), certified(j),
                1e-15 * solution.condition_number * 32 * std::pow(20.0, -j));
}

class NistPerturbed : public ::testing::TestWithParam<double> {};

TEST_P(NistPerturbed, CoefficientsAndDeviationsAreCertified) {
  const double factor = GetParam();
  const auto matrix = powers();
  const auto solution = solve_least_squares(
      matrix, matrix * Eigen::VectorXd::Ones(kColumns) + factor * perturbation());
  for (int j = 0; j < kColumns; ++j) {
    const double certified = factor * kCertifiedDeviations[static_cast<std::size_t>(j)];
    // The certified values have 15 digits; each step of the solution may lose the conditioning's three or four.
    EXPECT_NEAR(std::sqrt(solution.covariance(j, j)), certified, 1e-11 * certified)
        << "coefficient " << j;
    // A coefficient cannot be known better than its deviation, relative to rounding.
    EXPECT_NEAR(solution.coefficients(j), 1, 1e-11 * (certified + std::pow(20.0, 5 - j)))
        << "coefficient " << j;
  }
}

INSTANTIATE_TEST_SUITE_P(Wampler3To5, NistPerturbed, ::testing::Values(1.0, 100.0, 10000.0),
                         [](const auto& tested) {
                           return "PerturbedBy" + std::to_string(std::lround(tested.param));
                         });

}  // namespace
}  // namespace viscontact
