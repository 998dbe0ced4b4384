#include "viscontact/reduced_model/fit_uncertainty.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/reduced_model/cases.hpp"

namespace viscontact::reduced_model {
namespace {

/// R = k/q alone, so that q = q0 exp(I/k) at every time, with a standard error of k.
lubrication::Fit uncertain_leading_term(double k, double error) {
  lubrication::Fit fit = leading_term_fit(k);
  fit.covariance = {{error * error}};
  return fit;
}

TEST(FitUncertainty, OfTheLeadingTermAloneIsThatOfItsExponential) {
  // q = exp(-400/k): the 2.5 % and 97.5 % quantiles of k are k -+ 1.96 errors. With 10^4 draws such
  // a quantile is known to 3 % of the error.
  constexpr double k = 60, kError = 0.5;
  const auto result = propagate_fit(lecture_motion(), uncertain_leading_term(k, kError), 0);
  EXPECT_EQ(result.draws, 10000U);
  EXPECT_EQ(result.refused, 0U);
  EXPECT_EQ(result.smallest.time, 2);
  EXPECT_NEAR(result.smallest.gap / std::exp(-400 / k), 1, 1e-12);  // round-off times the exponent
  for (const std::size_t end : {0U, 1U}) {
    const double drawn = -400 / std::log(result.smallest.random[end]);  // the k of this gap
    EXPECT_NEAR((drawn - k) / kError, end == 0 ? -1.96 : 1.96, 0.1);
  }
}

TEST(FitUncertainty, ByTheMisfitScalesTheImpulse) {
  constexpr double k = 60;
  lubrication::Fit fit = leading_term_fit(k);
  fit.largest_relative_residual = 0.01;
  const auto result = propagate_fit(lecture_motion(), fit, 0);
  EXPECT_EQ(result.misfit, 0.01);
  EXPECT_NEAR(result.smallest.misfit[0] / std::exp(-400 * 1.01 / k), 1, 1e-12);
  EXPECT_NEAR(result.smallest.misfit[1] / std::exp(-400 * 0.99 / k), 1, 1e-12);
  EXPECT_EQ(result.smallest.random[0], result.smallest.gap);  // no covariance
}

TEST(FitUncertainty, LeavesOutliersOutOfTheMisfitWhichIsOneAtMost) {
  lubrication::Fit fit = leading_term_fit(60);
  fit.largest_relative_residual = 2;  // an outlier's
  fit.diagnostics = lubrication::FitDiagnostics();
  fit.diagnostics->largest_inlier_residual = 0.01;
  fit.diagnostics->largest_error_estimate = 0.02;
  EXPECT_DOUBLE_EQ(propagate_fit(lecture_motion(), fit, 0).misfit, 0.01 + 0.02 + 0.01 * 0.02);
  fit.diagnostics.reset();
  const auto result = propagate_fit(lecture_motion(), fit, 0);
  EXPECT_EQ(result.misfit, 1);
  EXPECT_LE(result.smallest.misfit[1], 1 + 1e-12);  // a push never opens the gap
}

TEST(FitUncertainty, UsesTheLimitsThatTheMotionUses) {
  lubrication::Fit fit = brenner_fit("lecture", {0.02, 2});
  fit.leading_coefficient = 56.548667764616276;
  const lubrication::OutsideInterval outside{lubrication::BelowInterval::kTheoryLimit};
  const lubrication::LubricationForce force(fit, outside);
  const double expected = force.gap_of_impulse(force.impulse(1) - 400);
  EXPECT_EQ(propagate_fit(lecture_motion(), fit, 0, outside).smallest.gap, expected);
  EXPECT_NE(propagate_fit(lecture_motion(), fit, 0).smallest.gap, expected);
}

TEST(FitUncertainty, HoldsTheExactMinimumOfTheLecturesCase) {
  const auto result = propagate_fit(lecture_motion(), lecture_fit(), 41);
  EXPECT_LT(result.smallest.misfit[0], kExactMinimalGap);
  EXPECT_GT(result.smallest.misfit[1], kExactMinimalGap);
  // Over time it begins at a point, and is widest where the film is thinnest.
  ASSERT_EQ(result.gaps.size(), 41U);
  const auto width = [](const UncertainGap& gap) {
    return (gap.misfit[1] - gap.misfit[0]) / gap.gap;
  };
  EXPECT_NEAR(width(result.gaps.front()), 0, 1e-14);
  const auto widest = std::ranges::max_element(result.gaps, {}, width);
  EXPECT_EQ(widest->time, 2);
  for (const auto& gap : result.gaps) {
    EXPECT_LE(gap.random[0], gap.gap * (1 + 1e-12));
    EXPECT_GE(gap.random[1], gap.gap * (1 - 1e-12));
  }
}

TEST(FitUncertainty, IsThatOfTheSmallestGapWhereTheForceTurnsWithinAPiece) {
  // The force -sin t has its lowest impulse, cos t - 1 = -2, at pi, and no jump.
  constexpr double k = 3;
  Motion motion = lecture_motion();
  motion.end_time = 5;
  motion.external_force = ExternalForce::sinusoidal({-1, 1, 0});
  const auto sine = propagate_fit(motion, leading_term_fit(k), 0);
  EXPECT_NEAR(sine.smallest.time, std::numbers::pi, 1e-12);
  EXPECT_NEAR(sine.smallest.gap / std::exp(-2 / k), 1, 1e-12);
  // Samples from -1 at 0 to 1 at 2, with the impulse -1/2 at 1.
  motion.end_time = 2;
  motion.external_force = ExternalForce({{2, -1, {1}}});
  const auto sampled = propagate_fit(motion, leading_term_fit(k), 0);
  EXPECT_NEAR(sampled.smallest.time, 1, 1e-12);
  EXPECT_NEAR(sampled.smallest.gap / std::exp(-0.5 / k), 1, 1e-12);
}

TEST(FitUncertainty, DoesNotFailForMorePeriodsThanCanBeFollowed) {
  Motion motion = lecture_motion();
  motion.external_force = ExternalForce::sinusoidal({1, 1e6, 0});
  EXPECT_EQ(propagate_fit(motion, leading_term_fit(60), 0).smallest.time, 0);
}

TEST(FitUncertainty, IsTheSameAtEachCall) {
  const auto one = propagate_fit(lecture_motion(), lecture_fit(), 3, {}, 100);
  const auto two = propagate_fit(lecture_motion(), lecture_fit(), 3, {}, 100);
  EXPECT_EQ(write_uncertainty(one), write_uncertainty(two));
}

TEST(FitUncertainty, CountsDrawsWhoseDragIsNotPositive) {
  // One standard error below zero: 16 %.
  const auto result = propagate_fit(lecture_motion(), uncertain_leading_term(60, 60), 0);
  EXPECT_NEAR(static_cast<double>(result.refused), 1587,
              150);  // four standard deviations of the count
}

TEST(FitUncertainty, IsReadBackAsItWasWritten) {
  const TemporaryFolder folder;
  const auto written = propagate_fit(lecture_motion(), lecture_fit(), 5, {}, 100);
  const auto read = read_uncertainty(folder.file("u.json", write_uncertainty(written)));
  EXPECT_EQ(write_uncertainty(read), write_uncertainty(written));
  const auto other = folder.file("other.json", "{\"draws\": 3}");
  EXPECT_THAT(bad_input([&] { read_uncertainty(other); }), IsAt(other.string()));
}

}  // namespace
}  // namespace viscontact::reduced_model
