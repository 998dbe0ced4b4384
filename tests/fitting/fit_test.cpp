#include "viscontact/lubrication/fit.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/motion_table.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::fitting {
namespace {

using ::testing::AllOf;

/// A figure of docs/theory.md, section 2, and half a unit of its last printed digit.
struct Printed {
  const char* basis;
  lubrication::Weights weights;
  double figure, half_digit;
};

class ExactDrag : public ::testing::TestWithParam<Printed> {};

TEST_P(ExactDrag, IsFittedAsWellAsTheoryAllows) {
  const auto& [basis, weights, figure, half_digit] = GetParam();
  const auto table = exact_drag_table(fifty_gaps(), {-1}, 1 / (6 * std::numbers::pi), 1);
  const auto fit = fit_force_table(table, basis, weights);
  EXPECT_NEAR(fit.largest_relative_residual, figure, half_digit);
  EXPECT_EQ(fit.gap_interval, (std::array{1e-3, 1.0}));
}

INSTANTIATE_TEST_SUITE_P(
    Fit, ExactDrag,
    ::testing::Values(Printed{"lecture", lubrication::Weights::kAbsolute, 3.3e-2, 0.05e-2},
                      Printed{"lecture", lubrication::Weights::kRelative, 2.5e-3, 0.05e-3},
                      Printed{"asymptotic", lubrication::Weights::kRelative, 6e-6, 0.5e-6}),
    [](const auto& tested) {
      const std::string weights(lubrication::to_string(tested.param.weights));
      return std::string(tested.param.basis) + "_" + weights;
    });

TEST(Fit, ReportsTheResidualsOfItsCoefficients) {
  for (const auto weights : {lubrication::Weights::kRelative, lubrication::Weights::kAbsolute}) {
    const auto table = exact_drag_table(fifty_gaps(), {-2}, 3, 1.5);
    const auto fit = fit_force_table(table, "lecture", weights);
    double largest = 0, squares = 0;
    for (const auto& row : table.rows) {
      const double residual = fitted_force(fit, row.gap) / row.force - 1;
      largest = std::max(largest, std::abs(residual));
      squares += residual * residual;
    }
    // Residuals of 1e-3 and more, each the difference of terms that are known to 1e-15 of the
    // force, times their cancellation.
    EXPECT_NEAR(fit.largest_relative_residual, largest, 1e-13);
    EXPECT_NEAR(fit.rms_relative_residual, std::sqrt(squares / 50), 1e-13);
    EXPECT_EQ(fit.viscosity, 3);
    EXPECT_EQ(fit.radius, 1.5);
    EXPECT_EQ(fit.reference_velocity, -2);
    EXPECT_EQ(fit.weights, weights);
    for (std::size_t i = 0; i < fit.terms.size(); ++i)
      EXPECT_EQ(fit.terms[i].standard_error, std::sqrt(fit.covariance[i][i])) << fit.terms[i].name;
  }
}

TEST(Fit, LeavesResidualsThatEveryTermIsOrthogonalTo) {
  // The normal equations, which make it the least-squares fit: sum of w^2 (fit - F) term = 0.
  for (const auto weights : {lubrication::Weights::kRelative, lubrication::Weights::kAbsolute}) {
    const auto table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
    const auto fit = fit_force_table(table, "lecture", weights);
    for (const auto& term : fit.terms) {
      double product = 0, residuals = 0, terms = 0, forces = 0;
      for (const auto& row : table.rows) {
        const double weight = weights == lubrication::Weights::kRelative ? 1 / row.force : 1;
        const double residual = weight * (fitted_force(fit, row.gap) - row.force);
        const double value = weight * lubrication::find_term(term.name)->value(row.gap);
        product += residual * value;
        residuals += residual * residual;
        terms += value * value;
        forces += weight * row.force * weight * row.force;
      }
      // The cosine of the angle is 0 up to the rounding of the forces (eps of their length, a
      // hundred operations) over the residual.
      const double rounding = 2e-14 * std::sqrt(forces / residuals);
      EXPECT_LT(std::abs(product) / std::sqrt(residuals * terms), rounding) << term.name;
    }
  }
}

TEST(Fit, RecoversPlantedCoefficients) {
  const std::vector<double> planted = {56.5, -12.25, 40, 3, -0.5, 2.5, -1, 0.25};
  for (const auto& basis : lubrication::all_bases()) {
    lubrication::MotionTable table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
    for (auto& row : table.rows) {
      row.force = 0;
      for (std::size_t i = 0; i < basis.terms.size(); ++i)
        row.force += planted.at(i) * basis.terms[i].value(row.gap);
    }
    const auto fit = fit_force_table(table, basis.name, lubrication::Weights::kRelative);
    ASSERT_EQ(fit.terms.size(), basis.terms.size());
    for (std::size_t i = 0; i < basis.terms.size(); ++i) {
      EXPECT_EQ(fit.terms[i].name, basis.terms[i].name);
      // Forces are rounded to eps = 2e-16; the conditioning brings it back, in units of the
      // smallest column (1e-2 of the largest).
      EXPECT_NEAR(fit.terms[i].coefficient, planted[i], 1e-13 * fit.condition_number)
          << basis.name << " " << fit.terms[i].name;
    }
    EXPECT_LT(fit.largest_relative_residual, 1e-14 * fit.condition_number);
  }
}

TEST(Fit, WithEveryCoefficientHeldIsRefused) {
  FitSettings settings;
  settings.basis = lubrication::parse_terms("1/q");
  settings.fix_leading = true;
  settings.leading_value = 56.5;
  bad_input([&] { fit_force_table(exact_drag_table(fifty_gaps(), {-1}, 3, 1), settings); });
}

TEST(Fit, NeedsAScaleForEachRow) {
  const auto table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
  const auto fitted_with = [&](std::size_t scales, double last) {
    FitSettings settings;
    settings.row_scales.assign(scales, 1);
    settings.row_scales.back() = last;
    return fit_force_table(table, settings);
  };
  EXPECT_NO_THROW(fitted_with(50, 1));
  for (const std::size_t scales : {std::size_t{1}, std::size_t{49}, std::size_t{51}})
    EXPECT_THAT(bad_input([&] { fitted_with(scales, 1); }), Names("0", "50"));
  for (const double last : {0.0, -1.0, std::nan("")})
    EXPECT_THAT(bad_input([&] { fitted_with(50, last); }), Names("0", "50"));
}

TEST(Fit, OfForcesThatNoDoubleCanSquareIsRefused) {
  auto table = exact_drag_table(fifty_gaps(), {-1}, 3, 1);
  table.rows[3].force = 1e305;
  bad_input([&] { fit_force_table(table, "lecture", lubrication::Weights::kAbsolute); });
}

TEST(Fit, OfSeveralVelocitiesIsTheFitOfOne) {
  // Stokes flow is linear: the force over the velocity is the same. Powers of two keep that exact
  // in doubles too.
  const auto one = fit_force_table(exact_drag_table(fifty_gaps(), {-1}, 3, 1), "lecture",
                                   lubrication::Weights::kRelative);
  const auto several = fit_force_table(exact_drag_table(fifty_gaps(), {-1, -4, 0.5}, 3, 1),
                                       "lecture", lubrication::Weights::kRelative);
  EXPECT_EQ(several.reference_velocity, -1);
  ASSERT_EQ(several.terms.size(), one.terms.size());
  for (std::size_t i = 0; i < one.terms.size(); ++i) {
    // The same minimum, by another sequence of roundings.
    const double rounding = 1e-14 * one.condition_number * std::abs(one.terms[i].coefficient);
    EXPECT_NEAR(several.terms[i].coefficient, one.terms[i].coefficient, rounding)
        << one.terms[i].name;
    // Rows of one gap at several velocities say nothing new.
    EXPECT_NEAR(several.terms[i].standard_error / one.terms[i].standard_error, 1, 1e-10);
  }
}

TEST(Fit, RefusesForcesThatAreNotLinearInTheVelocity) {
  auto table = exact_drag_table(fifty_gaps(), {-1, -4}, 3, 1);
  for (auto& row : table.rows) row.relative_error_estimate = 1e-6;
  table.rows.back().force *= 1 + 1.9e-6;  // within what the two rows' estimates allow together
  EXPECT_NO_THROW(fit_force_table(table, "lecture", lubrication::Weights::kRelative));
  table.rows.back().force *= 1 + 1e-6;
  EXPECT_THAT(
      bad_input([&] { fit_force_table(table, "lecture", lubrication::Weights::kRelative); }),
      Names("velocity"));
}

TEST(Fit, IsAtTheVelocityOfTheFirstRow) {
  const auto at_one = fit_force_table(exact_drag_table(fifty_gaps(), {-1, -4}, 3, 1), "lecture",
                                      lubrication::Weights::kRelative);
  const auto at_four = fit_force_table(exact_drag_table(fifty_gaps(), {-4, -1}, 3, 1), "lecture",
                                       lubrication::Weights::kRelative);
  EXPECT_EQ(at_four.reference_velocity, -4);
  for (std::size_t i = 0; i < at_one.terms.size(); ++i)
    EXPECT_NEAR(at_four.terms[i].coefficient, 4 * at_one.terms[i].coefficient,
                1e-14 * at_one.condition_number *
                    std::abs(4 * at_one.terms[i].coefficient));  // rounding, as above
}

TEST(Fit, IsTheSameInAllUnitsOfLength) {
  // Errors of 1e-4 leave the coefficients of the last terms undetermined, of some logarithms, too.
  const auto table_in = [](double unit) {
    auto table = exact_drag_table(log_spaced(1e-3 * unit, unit, 30), {-1}, 3, unit);
    for (std::size_t i = 0; i < table.rows.size(); ++i)
      table.rows[i].force *= (1 + 1e-4 * std::sin(7.0 * static_cast<double>(i * i))) / unit;
    return table;
  };
  const auto warnings_of = [](const lubrication::Fit& fit) {
    std::vector<std::string> terms;
    for (const auto& warning : fit.diagnostics->warnings)
      if (warning.find("is not determined") != std::string::npos)
        terms.push_back(warning.substr(0, warning.find(" is not")));
    return terms;
  };
  for (const auto* terms : {"1/q, ln q, 1, q ln q, q, q^2 ln q, q^2", "1/q, 1, q, q^2, q^3"}) {
    FitSettings settings;
    settings.basis = lubrication::parse_terms(terms);
    const auto plain = fit_force_table(table_in(1), settings);
    for (int decade = -5; decade <= 5; ++decade) {
      SCOPED_TRACE(decade);
      const double unit = 1.7 * std::pow(10, decade);
      const auto scaled = fit_force_table(table_in(unit), settings);
      // Rounding of the singular values, times the condition number of about 1e4.
      EXPECT_NEAR(scaled.condition_number / plain.condition_number, 1, 1e-9);
      EXPECT_EQ(warnings_of(scaled), warnings_of(plain));
      for (const double gap : {1e-3, 0.03, 0.8}) {
        // The terms with ln q cancel to a part of ln r, 12, of their sizes.
        EXPECT_NEAR(fitted_force(scaled, gap * unit) / fitted_force(plain, gap), 1, 1e-9);
      }
    }
  }
}

TEST(Fit, OfTheExactDragHasTheLeadingCoefficientOfTheory) {
  const auto fit = fit_force_table(exact_drag_table(fifty_gaps(), {-1}, 3, 1), "asymptotic",
                                   lubrication::Weights::kRelative);
  ASSERT_EQ(fit.terms[0].name, "1/q");
  // At the smallest gap 1/q is all but 2.4e-3 of the drag, and the fit is within 6e-6 of it there.
  EXPECT_NEAR(fit.terms[0].coefficient / (6 * std::numbers::pi * 3), 1, 1e-5);
}

TEST(Fit, NeedsAsManyDifferentGapsAsTerms) {
  // Ten rows, but four gaps.
  const auto table = exact_drag_table({0.1, 0.2, 0.3, 0.3, 0.4}, {-1, -2}, 3, 1);
  EXPECT_THAT(
      bad_input([&] { fit_force_table(table, "lecture", lubrication::Weights::kRelative); }),
      Names("4 different", "5"));
  EXPECT_THAT(bad_input([] {
                fit_force_table(lubrication::MotionTable{}, "lecture",
                                lubrication::Weights::kRelative);
              }),
              Names("0 different"));
}

TEST(Fit, OfGapsTooCloseTogetherDoesNotConverge) {
  std::vector<double> gaps;
  for (int i = 0; i < 10; ++i) gaps.push_back(0.5 * (1 + i * 1e-15));
  const auto table = exact_drag_table(gaps, {-1}, 3, 1);
  EXPECT_THAT(failure(ErrorKind::kNotConverged,
                      [&] { fit_force_table(table, "lecture", lubrication::Weights::kRelative); }),
              Names("apart"));
}

TEST(Fit, NamesAnUnknownBasis) {
  EXPECT_THAT(bad_input([] {
                fit_force_table(exact_drag_table(fifty_gaps(), {-1}, 3, 1), "cubic",
                                lubrication::Weights::kRelative);
              }),
              AllOf(Names("cubic"), Names("lecture")));
}

TEST(Weights, AreNamedAndReadBack) {
  for (const auto weights : {lubrication::Weights::kRelative, lubrication::Weights::kAbsolute})
    EXPECT_EQ(lubrication::parse_weights(lubrication::to_string(weights)), weights);
  EXPECT_EQ(lubrication::to_string(lubrication::Weights::kRelative), "relative");
  EXPECT_THAT(bad_input([] { lubrication::parse_weights("squared"); }),
              AllOf(Names("squared"), Names("relative", "absolute")));
}

}  // namespace
}  // namespace viscontact::fitting
