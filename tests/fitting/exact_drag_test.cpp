// What the bases make of the exact half-space drag: 60 gaps of Brenner's series.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/fitting/long_double_least_squares.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"

namespace viscontact::fitting {
namespace {

/// The lecture's case without inertia and with the exact drag (docs/theory.md, section 3).
constexpr double kExactMinimum = 2.97084661e-3;

struct Bar {
  const char* basis;
  double smallest_gap;
  double residual;       ///< largest relative
  double minimum_error;  ///< of q_min, relative
};

class OnExactDrag : public ::testing::TestWithParam<Bar> {
 protected:
  lubrication::MotionTable table() const {
    return exact_drag_table(log_spaced(GetParam().smallest_gap, 1, 60), {-1}, 3, 1);
  }
  lubrication::Fit fit() const {
    return fit_force_table(table(), GetParam().basis, lubrication::Weights::kRelative);
  }
};

TEST_P(OnExactDrag, LargestResidualIsWhatTheBasisAllows) {
  EXPECT_LE(fit().largest_relative_residual, GetParam().residual);
  EXPECT_GE(fit().largest_relative_residual, GetParam().residual / 10);  // no better than it can be
}

TEST_P(OnExactDrag, SmallestGapOfTheLecturesCaseFollows) {
  const lubrication::LubricationForce force(fit());
  const double minimum = force.gap_of_impulse(force.impulse(1) - 400);
  EXPECT_NEAR(minimum / kExactMinimum, 1, GetParam().minimum_error);
}

TEST_P(OnExactDrag, CoefficientsAreThoseOfExtendedPrecision) {
  const auto rows = table();
  const auto fitted = fit();
  const auto& terms = lubrication::find_basis(GetParam().basis).terms;
  Eigen::MatrixXd matrix(60, static_cast<Eigen::Index>(terms.size()));
  for (Eigen::Index i = 0; i < 60; ++i)
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
      const auto& row = rows.rows[static_cast<std::size_t>(i)];
      matrix(i, j) = terms[static_cast<std::size_t>(j)].value(row.gap) / row.force;
    }
  const auto exact = long_double_least_squares(matrix, Eigen::VectorXd::Ones(60));
  for (std::size_t j = 0; j < terms.size(); ++j) {
    const auto coefficient = static_cast<double>(exact.coefficients(static_cast<Eigen::Index>(j)));
    EXPECT_NEAR(fitted.terms[j].coefficient / coefficient, 1, 1e-10) << terms[j].name;
  }
}

INSTANTIATE_TEST_SUITE_P(Bases, OnExactDrag,
                         // Half a unit of the last digit of 2.5e-3.
                         ::testing::Values(Bar{"lecture", 1e-3, 2.55e-3, 2e-3},
                                           Bar{"asymptotic", 1e-3, 7e-6, 1e-6},
                                           Bar{"asymptotic_extended", 1e-4, 1e-8, 1e-8}),
                         [](const auto& test) { return std::string(test.param.basis); });

}  // namespace
}  // namespace viscontact::fitting
