
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/basis_comparison.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

FitSettings settings_of(std::string_view basis) {
  FitSettings settings;
  settings.basis = lubrication::find_basis(basis);
  return settings;
}

lubrication::MotionTable exact_table() { return exact_drag_table(fifty_gaps(), {-1}, 3, 1); }

/// R = k/q + 1 with the errors +-e in turn, which no smooth basis can follow.
lubrication::MotionTable table_with_noise(double noise, double estimate) {
  lubrication::MotionTable table = exact_table();
  double sign = 1;
  for (auto& row : table.rows) {
    row.force = (50 / row.gap + 1) * (1 + sign * noise);
    row.relative_error_estimate = estimate;
    sign = -sign;
  }
  return table;
}

lubrication::FitDiagnostics diagnostics_of(const lubrication::MotionTable& table,
                                           const FitSettings& settings) {
  return fit_force_table(table, settings).diagnostics.value();
}

TEST(LeaveOneOut, IsWhatFitsWithoutTheRowPredict) {
  const auto table = exact_table();
  for (const auto weights : {lubrication::Weights::kRelative, lubrication::Weights::kAbsolute}) {
    auto settings = settings_of("lecture");
    settings.weights = weights;
    const auto d = diagnostics_of(table, settings);
    double squares = 0;
    lubrication::LeftOutRow inner, end;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      lubrication::MotionTable others = table;
      others.rows.erase(others.rows.begin() + static_cast<std::ptrdiff_t>(i));
      const auto& row = table.rows[i];
      const double residual =
          std::abs(fitted_force(fit_force_table(others, settings), row.gap) / row.force - 1);
      squares += residual * residual;
      auto& largest = i == 0 || i + 1 == table.rows.size() ? end : inner;
      if (residual > largest.relative_residual) largest = {row.gap, residual};
    }
    // The same numbers by another way: round-off times the conditioning, over residuals of 1e-3 and
    // more.
    constexpr double kRoundOff = 1e-8;
    EXPECT_NEAR(d.leave_one_out_rms.value() / std::sqrt(squares / 50), 1, kRoundOff);
    for (const auto& [found, expected] :
         {std::pair{d.left_out_inner.value(), inner}, {d.left_out_end.value(), end}}) {
      EXPECT_NEAR(found.relative_residual / expected.relative_residual, 1, kRoundOff);
      EXPECT_EQ(found.gap, expected.gap);
    }
    const auto& largest = inner.relative_residual > end.relative_residual ? inner : end;
    EXPECT_NEAR(d.leave_one_out_largest.value() / largest.relative_residual, 1, kRoundOff);
    EXPECT_EQ(d.leave_one_out_gap, largest.gap);
  }
}

TEST(LeaveOneOut, OfAnEndRowIsAnExtrapolationAndNoWarning) {
  // README's example: twelve gaps. The last row left out, its force is extrapolated by a cubic.
  const auto table = exact_drag_table(log_spaced(1e-3, 2, 12), {-1}, 3, 1);
  const auto d = diagnostics_of(table, settings_of("lecture"));
  EXPECT_GT(d.left_out_end.value().relative_residual, 2);
  EXPECT_EQ(d.left_out_end.value().gap, 2);
  // The row next to it is an inner row, and is what the warning names.
  EXPECT_EQ(d.left_out_inner.value().gap, table.rows[10].gap);
  EXPECT_THAT(d.warnings, ElementsAre(Names("gap 1.002", "0.12")));
}

TEST(LeaveOneOut, OfInnerRowsIsAboveTheErrorBetweenTheRows) {
  // The drag is smooth: without a row its neighbours are twice as far apart, and the formula is
  // further off there than the whole fit is anywhere between the rows.
  for (const int count : {12, 20, 40}) {
    const auto gaps = log_spaced(1e-3, 2, count);
    const lubrication::Fit fit =
        fit_force_table(exact_drag_table(gaps, {-1}, 3, 1), settings_of("lecture"));
    double largest = 0;
    for (const auto& row : exact_drag_table(log_spaced(1e-3, 2, 400), {-1}, 3, 1).rows)
      largest = std::max(largest, std::abs(fitted_force(fit, row.gap) / row.force - 1));
    EXPECT_LT(largest, fit.diagnostics->left_out_inner.value().relative_residual) << count;
    // README's example: what the message said of it was 2.4.
    if (count == 12) {
      EXPECT_NEAR(largest, 2.8e-2, 1e-3);
    }
  }
}

TEST(LeaveOneOut, OfOneOfTwoRowsAtAnEndIsNoExtrapolation) {
  const auto d =
      diagnostics_of(exact_drag_table(fifty_gaps(), {-1, -2}, 3, 1), settings_of("lecture"));
  EXPECT_FALSE(d.left_out_end.has_value());
  EXPECT_EQ(d.left_out_inner.value().gap, d.leave_one_out_gap);
}

TEST(WorstResidual, IsFoundWithItsSign) {
  auto table = exact_table();
  table.rows[17].force *= 1.5;  // the fit lies below it
  const auto d = diagnostics_of(table, settings_of("asymptotic"));
  EXPECT_EQ(d.worst_gap, table.rows[17].gap);
  EXPECT_LT(d.worst_relative_residual, -0.2);
}

TEST(ChiSquared, IsTheSumOverTheRowsOfResidualOverEstimateSquared) {
  const auto table = table_with_noise(1e-4, 2e-4);
  const lubrication::Fit fit = fit_force_table(table, settings_of("lecture"));
  double sum = 0;
  for (const auto& row : table.rows)
    sum += std::pow((fitted_force(fit, row.gap) / row.force - 1) / row.relative_error_estimate, 2);
  const auto& d = *fit.diagnostics;
  EXPECT_NEAR(d.chi_squared.value() / sum, 1, 1e-9);  // residuals of 1e-4, to round-off
  EXPECT_EQ(d.degrees_of_freedom, 45U);
  EXPECT_EQ(d.largest_error_estimate, 2e-4);
}

TEST(Misfit, IsTheDatasOrTheBasiss) {
  // Noise within the estimates, beyond them (chi-squared 45 * 4 against a quantile of 70), and no
  // estimates.
  EXPECT_EQ(diagnostics_of(table_with_noise(1e-4, 2e-4), settings_of("lecture")).misfit,
            lubrication::Misfit::kData);
  EXPECT_EQ(diagnostics_of(table_with_noise(1e-4, 5e-5), settings_of("lecture")).misfit,
            lubrication::Misfit::kBasis);
  EXPECT_EQ(diagnostics_of(table_with_noise(1e-4, 0), settings_of("lecture")).misfit,
            lubrication::Misfit::kUnknown);
  auto table = table_with_noise(1e-4, 2e-4);
  table.rows.front().relative_error_estimate = 0;  // one without
  EXPECT_FALSE(diagnostics_of(table, settings_of("lecture")).chi_squared.has_value());
}

TEST(Misfit, ComparesEachRowWithItsOwnEstimate) {
  // One row is 1000 times less accurate than the others: every residual is below its estimate.
  auto table = table_with_noise(1e-4, 5e-5);
  table.rows.back().relative_error_estimate = 5e-2;
  const auto d = diagnostics_of(table, settings_of("lecture"));
  EXPECT_EQ(d.misfit, lubrication::Misfit::kBasis);
  EXPECT_LT(d.largest_inlier_residual, d.largest_error_estimate);
  std::size_t beyond = 0;
  double worst = 0;
  const lubrication::Fit fit = fit_force_table(table, settings_of("lecture"));
  for (const auto& row : table.rows) {
    const double ratio =
        std::abs(fitted_force(fit, row.gap) / row.force - 1) / row.relative_error_estimate;
    if (ratio > 1) ++beyond;
    worst = std::max(worst, ratio);
  }
  EXPECT_EQ(d.rows_beyond_estimate, beyond);
  EXPECT_GE(beyond, 40U);
  EXPECT_NEAR(d.worst_to_estimate.value().ratio / worst, 1,
              1e-9);  // residuals of 1e-4, to round-off
  EXPECT_NE(d.worst_to_estimate.value().gap, table.rows.back().gap);
}

TEST(Misfit, IsNotTheBasissWhereNoRowIsBeyondItsOwnEstimate) {
  const auto table = exact_drag_table(log_spaced(1e-3, 1, 10), {-1}, 3, 1);
  auto judged = table;
  const lubrication::Fit fit = fit_force_table(table, settings_of("asymptotic_extended"));
  ASSERT_EQ(fit.diagnostics->degrees_of_freedom, 2U);
  // Each residual 0.99 of its estimate: chi-squared 9.8, above the quantile 9.2 of two degrees.
  for (auto& row : judged.rows)
    row.relative_error_estimate = std::abs(fitted_force(fit, row.gap) / row.force - 1) / 0.99;
  const auto d = diagnostics_of(judged, settings_of("asymptotic_extended"));
  EXPECT_GT(d.chi_squared.value(), 9.3);
  EXPECT_EQ(d.rows_beyond_estimate, 0U);
  EXPECT_EQ(d.misfit, lubrication::Misfit::kData);
}

TEST(Misfit, IsJudgedWithoutTheOutliers) {
  auto table = table_with_noise(1e-5, 1e-4);
  table.rows[20].force *= 1.1;
  auto settings = settings_of("lecture");
  settings.loss = lubrication::Loss::kCauchy;
  const auto d = diagnostics_of(table, settings);
  ASSERT_EQ(d.outliers.size(), 1U);
  EXPECT_GT(d.chi_squared.value(), 1e5);  // of all rows: (0.09/1e-4)^2 and little more
  EXPECT_EQ(d.misfit, lubrication::Misfit::kData);
  EXPECT_EQ(d.rows_beyond_estimate, 0U);
}

TEST(Misfit, JudgesByTheQuantileOfChiSquared) {
  // 99 % quantile for 45 degrees of freedom: 69.957 (tables). +-noise/estimate = z in all 50 rows
  // gives about 50 z^2.
  for (const auto& [chi_squared, misfit] :
       {std::pair{68.0, lubrication::Misfit::kData}, {72.0, lubrication::Misfit::kBasis}}) {
    auto table = table_with_noise(1e-4, 1e-4);
    const double now = diagnostics_of(table, settings_of("lecture")).chi_squared.value();
    for (auto& row : table.rows) row.relative_error_estimate *= std::sqrt(now / chi_squared);
    const auto d = diagnostics_of(table, settings_of("lecture"));
    EXPECT_NEAR(d.chi_squared.value(), chi_squared, 1e-6);
    EXPECT_EQ(d.misfit, misfit);
  }
}

TEST(InformationCriterion, IsAkaikesForSmallSamples) {
  const auto table = exact_table();
  const lubrication::Fit fit = fit_force_table(table, settings_of("lecture"));
  const double n = 50, k = 6;
  const double expected =
      n * std::log(std::pow(fit.rms_relative_residual, 2)) + 2 * k + 2 * k * (k + 1) / (n - k - 1);
  EXPECT_NEAR(fit.diagnostics->information_criterion.value(), expected, 1e-9 * std::abs(expected));
}

TEST(InformationCriterion, NeedsMoreRowsThanCoefficients) {
  const auto table = exact_drag_table(log_spaced(1e-3, 1, 6), {-1}, 3, 1);
  EXPECT_FALSE(diagnostics_of(table, settings_of("lecture")).information_criterion.has_value());
}

TEST(Outliers, AreNamedByARobustLossOnly) {
  auto table = table_with_noise(1e-5, 1e-4);
  table.rows[20].force *= 1.1;
  auto settings = settings_of("lecture");
  EXPECT_THAT(diagnostics_of(table, settings).outliers, IsEmpty());
  for (const auto loss : {lubrication::Loss::kHuber, lubrication::Loss::kCauchy}) {
    settings.loss = loss;
    const auto d = diagnostics_of(table, settings);
    ASSERT_EQ(d.outliers.size(), 1U) << lubrication::to_string(loss);
    EXPECT_EQ(d.outliers[0].gap, table.rows[20].gap);
    EXPECT_EQ(d.outliers[0].reference_velocity, -1);
    EXPECT_NEAR(d.outliers[0].relative_residual, 1 / 1.1 - 1, 1e-4);  // noise, and Huber's pull
  }
}

TEST(Warnings, AreNoneForAGoodFit) {
  auto table = exact_table();
  table.leading_coefficient = 18 * std::numbers::pi;
  // The basis leaves 1e-8; with estimates below that, what it does to the leading coefficient would
  // be named.
  for (auto& row : table.rows) row.relative_error_estimate = 1e-7;
  EXPECT_THAT(diagnostics_of(table, settings_of("asymptotic_extended")).warnings, IsEmpty());
}

TEST(Warnings, SayThatTheLeadingCoefficientDepartsFromTheory) {
  auto table = table_with_noise(1e-5, 1e-4);
  table.leading_coefficient = 50.5;  // the table's is 50
  EXPECT_THAT(diagnostics_of(table, settings_of("lecture")).warnings,
              ::testing::Contains(Names("1/q", "50.5")));
  table.leading_coefficient = 50;
  EXPECT_THAT(diagnostics_of(table, settings_of("lecture")).warnings,
              ::testing::Not(::testing::Contains(HasSubstr("theory"))));
}

TEST(Warnings, SayThatACoefficientIsNotDetermined) {
  // The force is k/q + 1 and noise: the cubic's coefficients are noise.
  EXPECT_THAT(diagnostics_of(table_with_noise(1e-3, 1e-3), settings_of("lecture")).warnings,
              ::testing::Contains(Names("q^3")));
}

TEST(Warnings, SayThatTheResistanceIsNotMonotone) {
  auto table = exact_table();
  for (auto& row : table.rows) row.force = 1 / row.gap + 20 * row.gap;  // a minimum at 0.22
  EXPECT_THAT(diagnostics_of(table, settings_of("lecture")).warnings,
              ::testing::Contains(Names("resistance", "decrease")));
}

TEST(Warnings, SayThatTheResistanceIsNotPositive) {
  auto table = exact_table();
  table.neighbour_moves = true;
  for (auto& row : table.rows) row.force = 1 / row.gap - 10;  // changes sign at 0.1
  auto settings = settings_of("lecture");
  settings.weights = lubrication::Weights::kAbsolute;
  EXPECT_THAT(diagnostics_of(table, settings).warnings,
              ::testing::Contains(HasSubstr("not positive")));
}

TEST(DegreesOfFreedom, CountGapsAndNotRows) {
  // Rows of the same gaps at other velocities say nothing new, because the flow is linear: neither
  // standard errors nor any other measure of the fit depend on them.
  const auto gaps = log_spaced(1e-3, 1, 9);
  for (const auto* basis : {"lecture", "asymptotic"}) {
    const auto one = fit_force_table(exact_drag_table(gaps, {-1}, 3, 1), settings_of(basis));
    const auto more =
        fit_force_table(exact_drag_table(gaps, {-1, 2, -0.3}, 3, 1), settings_of(basis));
    const auto &a = *one.diagnostics, &b = *more.diagnostics;
    EXPECT_EQ(a.degrees_of_freedom, 4U);
    EXPECT_EQ(b.degrees_of_freedom, 4U);
    // Residuals of 1e-5 have 1e-10 of their digits left.
    EXPECT_NEAR(b.information_criterion.value() / a.information_criterion.value(), 1, 1e-8);
    for (std::size_t i = 0; i < one.terms.size(); ++i)
      EXPECT_NEAR(more.terms[i].standard_error / one.terms[i].standard_error, 1, 1e-8) << i;
  }
}

TEST(Warnings, SayThatTwoVelocitiesAddNoDegreeOfFreedom) {
  auto settings = settings_of("lecture");
  settings.basis = lubrication::parse_terms("1/q, ln q, 1");
  const auto fit = fit_force_table(exact_drag_table({0.01, 0.1, 1}, {-1, -2}, 3, 1), settings);
  EXPECT_EQ(fit.diagnostics->degrees_of_freedom, 0U);
  EXPECT_THAT(fit.diagnostics->warnings, ::testing::Contains(Names("coefficients", "rows")));
  for (const auto& term : fit.terms) EXPECT_EQ(term.standard_error, 0);
}

TEST(TwoWalls, AreFittedFromOneToTheOther) {
  // A drag that is singular at both walls, as between the floor and the lid of a cylinder.
  auto table = exact_drag_table(log_spaced(1e-2, 3.96, 24), {-1}, 3, 1);
  table.geometry = "plane";
  table.container = "closed cylinder, radius 20, height 6";
  for (auto& row : table.rows)
    row.force += 6 * std::numbers::pi * 3 * (brenner_drag_factor(4 - row.gap) - 1);
  const auto fit = fit_force_table(table, settings_of("two_walls"));
  EXPECT_LT(fit.largest_relative_residual, 2e-3);
  // Bases of one wall miss the force near the lid.
  EXPECT_GT(fit_force_table(table, settings_of("asymptotic_extended")).largest_relative_residual,
            0.1);
  const auto lid = std::ranges::find(fit.terms, "1/(L-q)", &lubrication::FitTerm::name);
  EXPECT_NEAR(lid->coefficient / (6 * std::numbers::pi * 3), 1, 0.01);
  EXPECT_EQ(compare_bases(table, settings_of("lecture")).back().basis, "two_walls");
  table.container = "unbounded";
  EXPECT_THROW(fit_force_table(table, settings_of("two_walls")), Error);
}

TEST(Warnings, SayThatThereAreAsManyCoefficientsAsRows) {
  const auto table = exact_drag_table(log_spaced(1e-3, 1, 5), {-1}, 3, 1);
  const auto d = diagnostics_of(table, settings_of("lecture"));
  EXPECT_THAT(d.warnings, ::testing::Contains(Names("coefficients", "rows")));
  EXPECT_FALSE(d.leave_one_out_rms.has_value());
}

}  // namespace
}  // namespace viscontact::fitting
