// Strokes of three spheres.
#include <gmock/gmock.h>

#include <Eigen/LU>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/oracles/exact_resistance_table.hpp"
#include "viscontact/swimmer/fit/fit_resistance.hpp"
#include "viscontact/swimmer/optimal_stroke.hpp"
#include "viscontact/swimmer/swim.hpp"

namespace viscontact::swimmer {
namespace {

/// Three equal spheres of radius 1, arms from 2.2 to 12: twelve values each, the shipped table of
/// the case three_spheres.toml.
const Swimmer& swimmer() {
  static const Swimmer instance(fit_resistance(
      read_resistance_table(VISCONTACT_SOURCE_FOLDER "/data/tables/three_spheres.csv")));
  return instance;
}

Eigen::VectorXd arms(double x1, double x2) { return Eigen::Vector2d(x1, x2); }

Stroke square(double low, double high, double period = 1) {
  return polygon_stroke({arms(low, low), arms(high, low), arms(high, high), arms(low, high)},
                        period);
}

// data/reference/swimmer.csv has the exact values. What is left is the error of table and fit.
TEST(Swim, SquareStrokeHasThePublishedDisplacementAndEnergy) {
  const auto sums = swim_sums(swimmer(), square(6, 10));
  EXPECT_NEAR(sums.displacement / 0.1598053403882, 1, 1e-6);
  EXPECT_NEAR(sums.energy / 3701.388296679, 1, 1e-6);
  EXPECT_NEAR(sums.energy_at_constant_power / 3700.50439521, 1, 1e-6);
}

TEST(Swim, LegsOfTheSquareMoveTheMiddleSphereAsPublished) {
  const auto rows = swim_rows(swimmer(), square(6, 10), 40);
  const auto position_at = [&](double time) {
    for (const auto& row : rows)
      if (std::abs(row.time - time) < 1e-12) return row.position;
    return std::nan("");
  };
  EXPECT_NEAR(position_at(0.25), 1.432537001995, 2e-6);
  EXPECT_NEAR(position_at(0.5), 1.432537001995 - 1.352634331801, 2e-6);
  EXPECT_NEAR(position_at(1), 0.1598053403882, 2e-7);
}

TEST(Swim, EllipseRunsClockwiseAndSwimsBackwards) {
  const auto stroke = elliptic_stroke(arms(6, 6), arms(1.5, 1.5), arms(0, std::numbers::pi / 2),
                                      2 * std::numbers::pi);
  const auto sums = swim_sums(swimmer(), stroke);
  EXPECT_NEAR(sums.displacement / -0.1197283084679, 1, 1e-6);
  EXPECT_NEAR(sums.energy * stroke.period / 1358.510232552, 1, 1e-6);
  EXPECT_NEAR(sums.energy_at_constant_power * stroke.period / 1327.54253637, 1, 1e-6);
}

TEST(Swim, ReciprocalStrokesSwimNowhere) {
  const auto line = polygon_stroke({arms(3, 4), arms(8, 10)}, 1);
  EXPECT_LT(std::abs(swim_sums(swimmer(), line).displacement), 1e-12);
  const auto flat = elliptic_stroke(arms(6, 6), arms(2, 3), arms(0.3, 0.3 + std::numbers::pi), 1);
  EXPECT_LT(std::abs(swim_sums(swimmer(), flat).displacement), 1e-12);
}

TEST(Swim, TimeLawAndPeriodDoNotChangeTheDisplacement) {
  const std::vector<Eigen::VectorXd> corners = {arms(6, 6), arms(10, 6), arms(10, 10), arms(6, 10),
                                                arms(6, 6)};
  const double even = swim_sums(swimmer(), square(6, 10)).displacement;
  const auto uneven = sampled_stroke({2, 2.1, 7, 7.5, 11}, corners);
  EXPECT_EQ(uneven.period, 9);
  EXPECT_NEAR(swim_sums(swimmer(), uneven).displacement, even, 1e-12);
  EXPECT_NEAR(swim_sums(swimmer(), square(6, 10, 100)).displacement, even, 1e-12);
}

TEST(Swim, NoForceIsExertedInTotalAndPowerIsThatOfTheForces) {
  const auto rows = swim_rows(swimmer(), square(3, 5), 100);
  double energy = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].forces.sum(), 0, 1e-11 * rows[i].forces.cwiseAbs().maxCoeff());
    EXPECT_GT(rows[i].power, 0);
    if (i > 0)
      energy += (rows[i].time - rows[i - 1].time) * (rows[i].power + rows[i - 1].power) / 2;
  }
  // The trapezoidal rule on 25 intervals a leg.
  EXPECT_NEAR(energy / swim_sums(swimmer(), square(3, 5)).energy, 1, 1e-3);
}

TEST(Swim, SmallStrokesOfDistantSpheresApproachGolestanianAndAjdarisFormula) {
  // Displacement = area (1/3) (1/x1^2 + 1/x2^2 - 1/(x1 + x2)^2), up to terms of relative order 1/x,
  // which halve as x doubles.
  const Swimmer distant(fit_resistance(exact_table({1, 1, 1}, 20, 200, 10)));
  const auto rest = [&](double x) {
    const double formula = (2 - 1. / 4) / (3 * x * x);
    return displacement_curl(distant, arms(x, x)) / formula - 1;
  };
  EXPECT_LT(std::abs(rest(160)), 0.02);
  EXPECT_NEAR(rest(80) / rest(160), 2, 0.1);
}

TEST(Swim, StrokeThatLeavesTheTableSaysWhere) {
  const auto message = bad_input([] { (void)swim_sums(swimmer(), square(6, 13)); });
  EXPECT_THAT(message, Names("12"));
  EXPECT_THAT(message, Names("2.2", "12"));
  // The border itself belongs to the table.
  EXPECT_NO_THROW((void)swim_sums(swimmer(), square(2.2, 12)));
}

TEST(Stroke, LoopThatDoesNotCloseIsRefused) {
  EXPECT_THAT(bad_input([] {
                (void)sampled_stroke({0, 1, 2}, {arms(6, 6), arms(7, 6), arms(6, 6.1)});
              }),
              Names("0.1"));
}

TEST(ShapeMechanics, SlopesAreThoseOfDifferences) {
  const auto at = swimmer().at(arms(3, 5), true);
  constexpr double kStep = 1e-5;  // differences are exact to 1e-10, rounding to 1e-11
  for (int k = 0; k < 2; ++k) {
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(2, k);
    const auto above = swimmer().at(arms(3, 5) + step), below = swimmer().at(arms(3, 5) - step);
    const auto i = static_cast<std::size_t>(k);
    EXPECT_LT((at.metric_slopes[i] - (above.metric - below.metric) / (2 * kStep)).norm(), 1e-7);
    EXPECT_LT((at.displacement_form_slopes[i] -
               (above.displacement_form - below.displacement_form) / (2 * kStep))
                  .norm(),
              1e-8);
  }
}

TEST(OptimalStroke, OfASmallDisplacementIsACircleInTheMetric) {
  // With constant curl B and metric G the least energy is 4 pi sqrt(det G) displacement / B (the
  // isoperimetric inequality). B and G vary by 1e-2 over this loop; its energy can gain from that.
  const OptimalStrokeRequest request{1e-5, arms(6, 6), 4};
  const auto optimal = find_optimal_stroke(swimmer(), request, {});
  const double formula = 4 * std::numbers::pi * request.displacement *
                         std::sqrt(swimmer().at(request.through).metric.determinant()) /
                         displacement_curl(swimmer(), request.through);
  EXPECT_NEAR(optimal.convergence.back().energy / formula, 1, 0.02);
}

TEST(OptimalStroke, ConvergesInItsPolynomialsAndSolvesEulerAndLagrangesEquation) {
  const OptimalStrokeRequest request{0.2, arms(6, 6), 20};
  const auto optimal = find_optimal_stroke(swimmer(), request, {});
  const auto& steps = optimal.convergence;
  ASSERT_GE(steps.size(), 4U);
  EXPECT_NEAR(steps[steps.size() - 2].energy / steps.back().energy, 1, 1e-8);
  EXPECT_LT(steps.back().euler_lagrange_residual, 1e-3);
  EXPECT_LT(steps.back().euler_lagrange_residual, steps.front().euler_lagrange_residual / 10);

  const auto sums = swim_sums(swimmer(), stroke_of(optimal.loop, 2));
  EXPECT_NEAR(sums.displacement, 0.2, 1e-10);
  EXPECT_NEAR(sums.energy * 2 / steps.back().energy, 1, 1e-8);
  // Its power is constant up to the error of the loop.
  EXPECT_NEAR(sums.energy_at_constant_power / sums.energy, 1, 1e-8);
  // The multiplier is the slope of the energy.
  const auto more = find_optimal_stroke(swimmer(), {0.2002, arms(6, 6), 20}, {});
  EXPECT_NEAR((more.convergence.back().energy - steps.back().energy) / 2e-4 / optimal.multiplier, 1,
              1e-3);
}

TEST(OptimalStroke, HasAsManyPolynomialsAsAreAskedFor) {
  // The search begins with 8 polynomials, also where fewer are asked for.
  for (const Eigen::Index polynomials : {4, 5, 7, 8, 9}) {
    SCOPED_TRACE(polynomials);
    const auto optimal = find_optimal_stroke(swimmer(), {0.2, arms(6, 6), polynomials}, {});
    EXPECT_EQ(optimal.loop.coefficients.cols(), polynomials);
    EXPECT_EQ(optimal.convergence.back().polynomials, polynomials);
    const auto sums = swim_sums(swimmer(), stroke_of(optimal.loop, 1));
    EXPECT_NEAR(sums.displacement, 0.2, 1e-10);
    EXPECT_NEAR(sums.energy / optimal.convergence.back().energy, 1, 1e-8);
  }
}

TEST(OptimalStroke, NeedsLessEnergyThanSquareAndEllipseOfItsDisplacement) {
  const auto sums = swim_sums(swimmer(), square(6, 10));
  const auto optimal = find_optimal_stroke(swimmer(), {sums.displacement, arms(6, 6), 12}, {});
  EXPECT_LT(optimal.convergence.back().energy, 0.9 * sums.energy_at_constant_power);
}

TEST(OptimalStroke, BackwardsIsTheSameLoopInTheOtherSense) {
  const auto forwards = find_optimal_stroke(swimmer(), {0.1, arms(6, 6), 6}, {});
  const auto backwards = find_optimal_stroke(swimmer(), {-0.1, arms(6, 6), 6}, {});
  EXPECT_NEAR(forwards.convergence.back().energy / backwards.convergence.back().energy, 1, 1e-9);
}

TEST(OptimalStroke, TooLargeADisplacementIsRefusedWithARemedy) {
  EXPECT_THAT(bad_input([] {
                (void)find_optimal_stroke(swimmer(), {50, arms(6, 6), 8}, {});
              }),
              Names("50"));
}

}  // namespace
}  // namespace viscontact::swimmer
