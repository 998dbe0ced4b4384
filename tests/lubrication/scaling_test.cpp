// Fits that are scaled to another radius and viscosity: the dimensionless force stays.
#include "viscontact/lubrication/scaling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

/// A fit with all terms, r = 1.3 and mu = 3, positive on its interval, with correlated errors.
Fit fit_of_all_terms() {
  Fit fit;
  fit.basis = kOwnTerms;
  fit.reference_velocity = -0.5;
  fit.viscosity = 3;
  fit.radius = 1.3;
  fit.gap_interval = {1e-3, 2};
  fit.geometry = "sphere, radius 2.6, velocity_ratio 0.5";
  fit.container = "closed cylinder, radius 40, height 80";
  fit.leading_coefficient = 90;
  double coefficient = 40;
  for (const auto& term : all_terms()) {
    fit.terms.push_back({std::string(term.name), coefficient, 0.01 * std::abs(coefficient), false});
    coefficient *= -0.12;
  }
  fit.terms[1].coefficient = -4;
  fit.terms[2].coefficient = 30;
  const auto size = fit.terms.size();
  fit.covariance.assign(size, std::vector<double>(size, 0.0));
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < size; ++j)
      fit.covariance[i][j] =
          (i == j ? 1 : 0.3) * fit.terms[i].standard_error * fit.terms[j].standard_error;
  return fit;
}

TEST(ScaledFit, HasTheForceOfTheSameGapInRadiiOverTenDecades) {
  const Fit fit = fit_of_all_terms();
  const LubricationForce force(fit, OutsideInterval{}.with_limits());
  std::mt19937_64 generator(36);
  std::uniform_real_distribution<double> decades(-5, 5);
  for (int i = 0; i < 50; ++i) {
    const double viscosity = std::pow(10, decades(generator));
    const double radius = std::pow(10, decades(generator));
    const double ratio = radius / fit.radius;
    const LubricationForce scaled(scaled_to(fit, viscosity, radius),
                                  OutsideInterval{}.with_limits());
    const double of_resistance = viscosity / fit.viscosity * ratio;
    // The logarithm of the ratio, up to 12, multiplies the roundings of terms that cancel.
    for (const double gap : spread_gaps({1e-5, 50})) {
      EXPECT_NEAR(scaled.resistance(gap * ratio) / of_resistance / force.resistance(gap), 1, 1e-12)
          << gap << " " << radius;
      const double size = std::max(std::abs(force.impulse(gap)), gap * force.resistance(gap));
      EXPECT_NEAR(scaled.impulse(gap * ratio) / (of_resistance * ratio), force.impulse(gap),
                  1e-12 * size)
          << gap << " " << radius;
    }
  }
}

/// Variance of the force at a gap by the covariance of the coefficients.
double variance(const Fit& fit, double gap) {
  double sum = 0;
  for (std::size_t i = 0; i < fit.terms.size(); ++i)
    for (std::size_t j = 0; j < fit.terms.size(); ++j)
      sum += fit.covariance[i][j] * find_term(fit.terms[i].name)->value(gap) *
             find_term(fit.terms[j].name)->value(gap);
  return sum;
}

TEST(ScaledFit, HasTheErrorsLengthsAndTheoryOfTheNewSphere) {
  const Fit fit = fit_of_all_terms();
  const Fit scaled = scaled_to(fit, 6, 0.65);
  EXPECT_EQ(scaled.radius, 0.65);
  EXPECT_EQ(scaled.viscosity, 6);
  EXPECT_DOUBLE_EQ(scaled.gap_interval[1], 1);
  EXPECT_DOUBLE_EQ(*scaled.leading_coefficient, 90 * 2 * 0.25);  // k is proportional to mu r^2
  EXPECT_EQ(scaled.geometry, "sphere, radius 1.3, velocity_ratio 0.5");
  EXPECT_EQ(scaled.container, "closed cylinder, radius 20, height 40");
  // The force at one velocity is multiplied by 2 * 0.5. The roundings are those of the terms.
  for (const double gap : {0.01, 0.1, 1.0})
    EXPECT_NEAR(variance(scaled, gap / 2) / variance(fit, gap), 1, 1e-12) << gap;
  for (std::size_t i = 0; i < scaled.terms.size(); ++i)
    EXPECT_NEAR(scaled.terms[i].standard_error, std::sqrt(scaled.covariance[i][i]), 1e-15);
}

TEST(ScaledFit, GetsTheTermsThatLogarithmsNeed) {
  Fit fit = fit_of_all_terms();
  fit.terms = {{"1/q", 40, 0.1, false}, {"ln q", -4, 0.2, true}};
  fit.covariance = {{0.01, 0}, {0, 0.04}};
  const Fit scaled = scaled_to(fit, fit.viscosity, 2.6);
  ASSERT_EQ(scaled.terms.size(), 3U);
  EXPECT_EQ(scaled.terms[2].name, "1");
  EXPECT_DOUBLE_EQ(scaled.terms[0].coefficient, 2 * 2 * 40);
  EXPECT_DOUBLE_EQ(scaled.terms[1].coefficient, 2 * -4);
  EXPECT_DOUBLE_EQ(scaled.terms[2].coefficient, 2 * 4 * std::log(2));
  EXPECT_TRUE(scaled.terms[1].is_fixed);
  EXPECT_EQ(scaled.covariance.size(), 3U);
}

TEST(ScaledFit, ChangesNoBitOfAFitOfTheSameSphereAndFluid) {
  const Fit fit = fit_of_all_terms();
  EXPECT_EQ(write_fit(scaled_to(fit, fit.viscosity, fit.radius)), write_fit(fit));
  EXPECT_EQ(write_fit(scaled_to(fit, 5, fit.radius)), write_fit(with_viscosity(fit, 5)));
}

TEST(ScaledFit, OfTheExactDragIsTheExactDrag) {
  EXPECT_EQ(write_fit(scaled_to(exact_plane_fit(1, 1), 2, 3)), write_fit(exact_plane_fit(2, 3)));
}

TEST(ScaledFit, EveryTermIsAPowerOrAPowerTimesTheLogarithm) {
  // The rule by which terms are scaled. A new term must obey it too.
  for (const auto& term : all_terms()) {
    const std::string name(term.name);
    const bool has_logarithm = name.ends_with("ln q");
    for (const double gap : {0.3, 2.0}) {
      const double scale = scale_of_term(name, 5);
      const double power = has_logarithm ? term.value(gap) / std::log(gap) : term.value(gap);
      const double beside = has_logarithm ? std::log(5) * scale * power : 0;
      EXPECT_NEAR(term.value(gap / 5), scale * term.value(gap) - beside,
                  1e-14 * (std::abs(beside) + std::abs(term.value(gap / 5))))
          << name;
    }
  }
}

TEST(WordsOfAGeometry, AreEqualUpToRounding) {
  EXPECT_TRUE(same_words("plane", "plane"));
  EXPECT_TRUE(same_words("sphere, radius 0.3", "sphere, radius 0.30000000000000004"));
  EXPECT_FALSE(same_words("sphere, radius 0.3", "sphere, radius 0.31"));
  EXPECT_FALSE(same_words("plane", "plane, unbounded"));
  EXPECT_FALSE(same_words("plane", "cavity"));
}

}  // namespace
}  // namespace viscontact::lubrication
