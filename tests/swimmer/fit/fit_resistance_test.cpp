#include "viscontact/swimmer/fit/fit_resistance.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/common/failure.hpp"
#include "tests/oracles/exact_resistance_table.hpp"
#include "viscontact/swimmer/resistance/resistance_fit.hpp"

namespace viscontact::swimmer {
namespace {

/// The largest relative error of an entry at points between the rows.
double error_between_rows(const ResistanceFit& fit) {
  const FittedResistance resistance(fit);
  double largest = 0;
  for (const double p : {0.22, 0.5, 1.3, 4.4, 9.1})
    for (const double q : {0.27, 0.9, 2.6, 7.7}) {
      const auto exact = exact_resistance(fit.radii, {p, q});
      const auto fitted = resistance(std::array{p, q}).value;
      largest = std::max(largest, ((fitted - exact).array() / exact.array()).abs().maxCoeff());
    }
  return largest;
}

TEST(FitResistance, ConvergesGeometricallyAndItsErrorsAreBelowThoseOfRowsThatAreLeftOut) {
  std::vector<double> errors;
  for (const int count : {6, 9, 12}) {
    const auto fit = fit_resistance(exact_table({1, 1, 1}, 2.2, 12, count));
    errors.push_back(error_between_rows(fit));
    EXPECT_LT(errors.back(), fit.largest_left_one_out_error) << count;
    EXPECT_LE(fit.rms_left_one_out_error, fit.largest_left_one_out_error);
    EXPECT_LT(fit.largest_relative_residual, 1e-12) << count;
  }
  EXPECT_LT(errors.back(), 1e-6);
  EXPECT_LT(errors.back(), errors.front() / 200);
}

TEST(FitResistance, TakesTheLubricationOutThatLeavesThePositiveDefiniteRest) {
  EXPECT_EQ(fit_resistance(exact_table({1, 1, 1}, 2.2, 12, 8)).lubrication_terms, 3);
  // Beside a sphere ten times larger all three terms are more than the resistance of the small one.
  const auto fit = fit_resistance(exact_table({1, 0.1, 1}, 1.5, 12, 6));
  EXPECT_LT(fit.lubrication_terms, 3);
}

TEST(FitResistance, NeedsAllCombinationsOfThreeArms) {
  auto table = exact_table({1, 1, 1}, 3, 9, 3);
  table.rows.pop_back();
  EXPECT_THAT(bad_input([&] { (void)fit_resistance(table); }), Names("8", "9"));
  EXPECT_THAT(bad_input([] { (void)fit_resistance(exact_table({1, 1, 1}, 3, 9, 2)); }), Names("3"));
}

TEST(PerturbedFits, DifferByTheErrorsOfPolynomialsAndTable) {
  const auto table = exact_table({1, 1, 1}, 2.2, 12, 8, 1e-4);
  const auto fit = fit_resistance(table);
  const auto perturbed = perturbed_fits(table, fit);
  ASSERT_EQ(perturbed.lower_degrees.size(), 2U);
  ASSERT_EQ(perturbed.table_errors.size(), 16U);
  const std::array gaps = {0.7, 3.0};
  const auto value = FittedResistance(fit)(gaps).value;
  const double truth = (value - exact_resistance(fit.radii, {0.7, 3})).norm() / value.norm();
  double lower = 0;
  for (const auto& other : perturbed.lower_degrees)
    lower += (FittedResistance(other)(gaps).value - value).norm() / value.norm();
  EXPECT_GT(lower, truth);
  for (const auto& other : perturbed.table_errors) {
    const double change = (FittedResistance(other)(gaps).value - value).norm() / value.norm();
    EXPECT_GT(change, 1e-6);
    EXPECT_LT(change, 3e-4);  // interpolation adds errors of several rows
  }
}

}  // namespace
}  // namespace viscontact::swimmer
