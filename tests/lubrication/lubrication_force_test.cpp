#include "viscontact/lubrication/lubrication_force.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/fit_force_table.hpp"

namespace viscontact::lubrication {
namespace {

Fit exact_fit(std::string_view basis, double velocity = -1) {
  return fitting::fit_force_table(
      fitting::exact_drag_table(fitting::fifty_gaps(), {velocity}, 3, 1), basis,
      Weights::kRelative);
}

/// int_from^to f by Simpson's rule in ln q.
template <class Function>
double simpson(const Function& f, double from, double to) {
  constexpr int kIntervals = 4000;
  const double h = std::log(to / from) / kIntervals;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double gap = i == 0 ? from : i == kIntervals ? to : from * std::exp(i * h);
    sum += (i == 0 || i == kIntervals ? 1 : i % 2 == 1 ? 4 : 2) * f(gap) * gap;
  }
  return sum * h / 3;
}

class OnBothBases : public ::testing::TestWithParam<std::string> {};

TEST_P(OnBothBases, ResistanceIsTheTablesForceWithinTheFitsResidual) {
  const auto table = fitting::exact_drag_table(fitting::fifty_gaps(), {-1}, 3, 1);
  const Fit fit = fitting::fit_force_table(table, GetParam(), Weights::kRelative);
  const LubricationForce force(fit);
  for (const auto& row : table.rows)
    // Some rounding (1e-13) beside the residual that the fit itself states.
    EXPECT_NEAR(-force.resistance(row.gap) * row.reference_velocity / row.force, 1,
                fit.largest_relative_residual + 1e-13);
}

TEST_P(OnBothBases, ResistanceDoesNotDependOnTheVelocityOfTheFit) {
  // F_lub(q, u) = -R(q) u is linear in u: a table at another velocity has the same R.
  const LubricationForce force(exact_fit(GetParam(), -1));
  const LubricationForce receding(exact_fit(
      GetParam(), 8));  // a power of two: scaling is exact but for the solver's own roundings
  for (const double gap : fitting::log_spaced(1e-3, 1, 23))
    EXPECT_NEAR(receding.resistance(gap) / force.resistance(gap), 1,
                1e-12);  // eps times the conditioning (some 1e2)
}

TEST_P(OnBothBases, LogSlopeIsGapTimesTheDerivativeOfTheResistance) {
  const LubricationForce force(exact_fit(GetParam()), {BelowInterval::kLubricationLimit});
  for (const double gap : {1e-5, 5e-4, 2e-3, 0.1, 0.9}) {
    const double h = std::ldexp(gap, -8);
    const auto r = [&](double q) { return force.resistance(q); };
    const double slope =
        (8 * (r(gap + h) - r(gap - h)) - (r(gap + 2 * h) - r(gap - 2 * h))) / (12 * h);
    // Five points: off by 4 (h/q)^4 of the leading term's k/q^2, 1e-9 of it.
    EXPECT_NEAR(force.resistance_log_slope(gap) / gap, slope,
                2e-9 * force.leading_coefficient() / (gap * gap))
        << "at gap " << gap;
  }
}

TEST_P(OnBothBases, ImpulseIsTheIntegralOfTheResistance) {
  const LubricationForce force(exact_fit(GetParam()), {BelowInterval::kLubricationLimit});
  const auto resistance = [&](double gap) { return force.resistance(gap); };
  // Simpson in ln q: h^4/180 ((ln q)^4-derivative of q R, at most 81 q R for q^4 terms) < 1e-11 of
  // the whole.
  EXPECT_EQ(force.impulse(1), 0) << "q_ref is the radius";
  EXPECT_NEAR(-force.impulse(1e-3), simpson(resistance, 1e-3, 1),
              1e-10 * std::abs(force.impulse(1e-3)));
  EXPECT_NEAR(force.impulse(0.7) - force.impulse(0.02), simpson(resistance, 0.02, 0.7),
              1e-10 * std::abs(force.impulse(1e-3)));
  // Below the interval.
  EXPECT_NEAR(force.impulse(1e-3) - force.impulse(1e-6), simpson(resistance, 1e-6, 1e-3),
              1e-10 * std::abs(force.impulse(1e-6)));
}

TEST_P(OnBothBases, RegularResistanceIsWhatIsLeftWithoutTheLeadingTerm) {
  const LubricationForce force(exact_fit(GetParam()));
  for (const double gap : fitting::log_spaced(1e-3, 1, 23)) {
    const double singular = force.leading_coefficient() / gap;
    EXPECT_NEAR(force.regular_resistance(gap), force.resistance(gap) - singular,
                4e-16 * (force.resistance(gap) + singular) * 4)
        << "a few roundings of the terms, at gap " << gap;
  }
  EXPECT_EQ(force.regular_resistance(1e-5), force.regular_resistance(1e-3));
  EXPECT_EQ(force.regular_resistance(0), force.regular_resistance(1e-3));
}

TEST_P(OnBothBases, IsContinuousAtTheLowerEndOfItsInterval) {
  const LubricationForce force(exact_fit(GetParam()), {BelowInterval::kLubricationLimit});
  const double gap = 1e-3;
  const double below = std::nextafter(gap, 0.0);
  // One unit in the last place of q changes R and Gamma by as many of theirs; both are sums of a
  // few rounded terms.
  EXPECT_NEAR(force.resistance(below), force.resistance(gap), 4e-15 * force.resistance(gap));
  EXPECT_NEAR(force.impulse(below), force.impulse(gap), 4e-15 * std::abs(force.impulse(gap)));
}

TEST_P(OnBothBases, TendsToTheLubricationLimitBelowItsInterval) {
  const LubricationForce force(exact_fit(GetParam()), {BelowInterval::kLubricationLimit});
  for (const double gap : {1e-4, 1e-8, 1e-100, 1e-300}) {
    const double limit = force.leading_coefficient() / gap + force.regular_resistance(1e-3);
    EXPECT_DOUBLE_EQ(force.resistance(gap), limit);
  }
}

TEST_P(OnBothBases, RefusesGapsOutsideItsIntervalAndNamesIt) {
  const LubricationForce force(exact_fit(GetParam()));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double gap : {0.9e-3, 1.1, 0.0, -1.0, nan}) {
    const auto names_interval = Names("0.001");
    EXPECT_THAT(bad_input([&] { force.resistance(gap); }), names_interval) << gap;
    EXPECT_THAT(bad_input([&] { force.resistance_log_slope(gap); }), names_interval) << gap;
    EXPECT_THAT(bad_input([&] { force.impulse(gap); }), names_interval) << gap;
  }
  EXPECT_THAT(bad_input([&] { force.resistance(1e-4); }), Names("0.0001"));
  EXPECT_THAT(bad_input([&] { force.regular_resistance(1.1); }), Names("0.001"));
  EXPECT_EQ(force.interval(), (std::array{1e-3, 1.0}));
}

TEST_P(OnBothBases, WithTheLubricationLimitRefusesOnlyWhatIsNoGap) {
  const LubricationForce force(exact_fit(GetParam()), {BelowInterval::kLubricationLimit});
  for (const double gap : {0.0, -1.0, 1.1, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(bad_input([&] { force.resistance(gap); }), Names("0.001")) << gap;
    EXPECT_THAT(bad_input([&] { force.impulse(gap); }), Names("0.001")) << gap;
  }
  EXPECT_EQ(force.interval(), (std::array{0.0, 1.0}));
}

INSTANTIATE_TEST_SUITE_P(LubricationForce, OnBothBases, ::testing::Values("lecture", "asymptotic"),
                         [](const auto& tested) { return tested.param; });

TEST(LubricationForce, OfTheLeadingTermAloneIsTheLecturesLogarithm) {
  // Gamma = k ln(q / r); the fit is at u0 = -1, so k is its coefficient.
  Fit fit = fitting::planted_fit({{"1/q", 56.5}}, 1e-4, 4);
  fit.radius = 2;
  const LubricationForce force(fit);
  EXPECT_EQ(force.leading_coefficient(), 56.5);
  for (const double gap : {1e-4, 0.3, 2.0, 4.0}) {
    EXPECT_DOUBLE_EQ(force.resistance(gap), 56.5 / gap);
    EXPECT_NEAR(force.impulse(gap), 56.5 * std::log(gap / 2), 1e-15 * 56.5 * 20)
        << "ln q and ln r are rounded apart";
    EXPECT_EQ(force.regular_resistance(gap), 0);
  }
  EXPECT_EQ(force.radius(), 2);
  EXPECT_EQ(force.viscosity(), 3);
}

TEST(LubricationForce, RefusesAFitThatIsNotADrag) {
  // 1/q - 10 changes sign at q = 0.1, inside the interval.
  EXPECT_THAT(bad_input([] {
                LubricationForce(fitting::planted_fit({{"1/q", 1}, {"1", -10}}, 1e-3, 1));
              }),
              Names("resistance"));
  // A force along its velocity.
  Fit fit = fitting::planted_fit({{"1/q", 1}}, 1e-3, 1);
  fit.reference_velocity = 1;
  EXPECT_THAT(bad_input([&] { LubricationForce{fit}; }), Names("resistance"));
}

TEST(LubricationForce, WithoutALeadingTermHasNoLubricationLimit) {
  const Fit fit = fitting::planted_fit({{"1", 2}}, 1e-3, 1);
  EXPECT_EQ(LubricationForce(fit).resistance(0.5), 2);
  EXPECT_THAT(bad_input([&] { LubricationForce(fit).leading_coefficient(); }), Names("1/q"));
  const LubricationForce force(fit, {BelowInterval::kLubricationLimit});
  EXPECT_THAT(bad_input([&] { force.resistance(1e-4); }), Names("1/q"));
  EXPECT_THAT(bad_input([&] { force.impulse(1e-4); }), Names("1/q"));
}

TEST(LubricationForce, OfThePlaneRefusesWhatIsNoGap) {
  const auto plane = LubricationForce::exact_plane(3, 2), below = plane.below_wall(4);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double gap : {-1.0, std::nan(""), infinity})
    for (const auto& force : {plane, below}) {
      EXPECT_THAT(bad_input([&] { force.resistance(gap); }), Names("gap")) << gap;
      EXPECT_THAT(bad_input([&] { force.regular_resistance(gap); }), Names("gap")) << gap;
      EXPECT_THAT(bad_input([&] { force.regular_impulse(gap); }), Names("gap")) << gap;
    }
  EXPECT_THAT(bad_input([&] { below.regular_resistance(4); }), Names("4"));
  EXPECT_THAT(bad_input([&] { below.regular_impulse(4); }), Names("4"));
  EXPECT_EQ(plane.regular_impulse(0), 0);
  EXPECT_EQ(plane.regular_resistance(0), plane.regular_resistance(2e-300));
  const LubricationForce fitted(exact_fit("lecture"));
  EXPECT_THAT(bad_input([&] { fitted.regular_resistance(-1); }), Names("0.001"));
  EXPECT_THAT(bad_input([&] { fitted.regular_impulse(-1); }), Names("0.001"));
}

TEST(LubricationForce, CoversAnIntervalWiderThanADoublesQuotient) {
  const LubricationForce force(fitting::planted_fit({{"1/q", 0.1}}, 1e-300, 1e300));
  for (const double gap : {1e-300, 1.0, 1e300}) EXPECT_DOUBLE_EQ(force.resistance(gap), 0.1 / gap);
}

}  // namespace
}  // namespace viscontact::lubrication
