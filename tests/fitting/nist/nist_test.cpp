// Our least squares on the NIST Statistical Reference Datasets. bench/README.md has the digits
// reached, bench_nist prints them.
#include <gtest/gtest.h>

#include <string>

#include "tests/fitting/nist/nist_sets.hpp"

namespace viscontact::fitting {
namespace {

class Nist : public ::testing::TestWithParam<std::string_view> {};

TEST_P(Nist, SevenCertifiedDigitsAreReached) {
  const auto reached = digits_reached(read_nist_set(GetParam()));
  EXPECT_GE(reached.coefficients, 7);
  EXPECT_GE(reached.deviations, 7);
}

INSTANTIATE_TEST_SUITE_P(Sets, Nist, ::testing::ValuesIn(nist_sets().begin(), nist_sets().end()),
                         [](const auto& test) { return std::string(test.param); });

TEST(NistExactData, LeavesDeviationsThatAreRoundOff) {
  // Certified: 0. The data have 7 digits, so the residuals' round-off is eps times that, times the
  // conditioning.
  for (const auto* name : {"Wampler1", "Wampler2"}) {
    const auto set = read_nist_set(name);
    const auto solution = solve_least_squares(set.matrix, set.right_hand_side);
    for (Eigen::Index j = 0; j < set.matrix.cols(); ++j)
      EXPECT_LT(std::sqrt(solution.covariance(j, j)),
                1e-15 * solution.condition_number * set.right_hand_side.cwiseAbs().maxCoeff())
          << name << " " << j;
  }
}

}  // namespace
}  // namespace viscontact::fitting
