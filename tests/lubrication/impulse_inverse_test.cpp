#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <random>
#include <string_view>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/fitting/samples.hpp"
#include "viscontact/fitting/fit_force_table.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

/// What round-off allows the inverse at `gap`, relative: it works on ln q, whose own rounding is
/// eps |ln q|, and Gamma is a sum of terms that are each rounded and may cancel; dq/q = dGamma / (R
/// q). A handful of roundings of each.
double round_off(const Fit& fit, const LubricationForce& force, double gap) {
  double sizes = std::abs(force.impulse(gap));
  for (const auto& term : fit.terms) {
    const auto antiderivative = find_term(term.name)->antiderivative;
    const double from = std::max(gap, fit.gap_interval[0]);
    sizes += std::abs(term.coefficient / fit.reference_velocity) *
             (std::abs(antiderivative(from)) + std::abs(antiderivative(fit.radius)));
  }
  return 4 * kEpsilon * (1 + std::abs(std::log(gap)) + sizes / (force.resistance(gap) * gap));
}

struct Sample {
  const char* name;
  Fit fit;
  BelowInterval below;
  double smallest_gap;
};

void PrintTo(const Sample& sample, std::ostream* stream) {
  *stream << sample.name;
}  // for GoogleTest's messages

std::vector<Sample> samples() {
  const auto exact = [](std::string_view basis) {
    return fitting::fit_force_table(
        fitting::exact_drag_table(fitting::log_spaced(1e-3, 2, 40), {-1}, 3, 1), basis,
        Weights::kRelative);
  };
  const auto limit = BelowInterval::kLubricationLimit;
  return {{"Lecture", exact("lecture"), BelowInterval::kError, 1e-3},
          {"Asymptotic", exact("asymptotic"), BelowInterval::kError, 1e-3},
          {"LectureBelow", exact("lecture"), limit, 1e-12},
          {"AsymptoticBelow", exact("asymptotic"), limit, 1e-12},
          {"LeadingTermFarBelow", fitting::planted_fit({{"1/q", 56.5}}, 1e-3, 2), limit, 1e-300},
          {"NegativeRegularPartBelow",
           fitting::planted_fit({{"1/q", 1}, {"1", -5}, {"q", 10}}, 0.125, 2), limit, 1e-9},
          {"LargeRegularPartBelow", fitting::planted_fit({{"1/q", 1e-3}, {"1", 50}}, 0.5, 2), limit,
           1e-9},
          {"NoLeadingTerm", fitting::planted_fit({{"1", 2}, {"q^3", 1}}, 1e-3, 2),
           BelowInterval::kError, 1e-3}};
}

class Inverse : public ::testing::TestWithParam<Sample> {};

TEST_P(Inverse, GivesTheGapBackToRoundOff) {
  const auto& [name, fit, below, smallest] = GetParam();
  const LubricationForce force(fit, {below});
  const double largest = fit.gap_interval[1];
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> logarithm(std::log(smallest), std::log(largest));
  double worst = 0, worst_gap = 0;
  constexpr int kGaps = 100'000;
  for (int i = 0; i < kGaps; ++i) {
    const double gap = std::clamp(std::exp(logarithm(random)), smallest, largest);
    const double error =
        std::abs(force.gap_of_impulse(force.impulse(gap)) / gap - 1) / round_off(fit, force, gap);
    if (error > worst) {
      worst = error;
      worst_gap = gap;
    }
  }
  EXPECT_LE(worst, 1) << "at gap " << worst_gap;
}

TEST_P(Inverse, GivesTheEndsOfTheIntervalBack) {
  const auto& [name, fit, below, smallest] = GetParam();
  const LubricationForce force(fit, {below});
  const auto [from, to] = fit.gap_interval;
  double gap_above = from;
  double gap_below = to;
  for (int i = 0; i < 20;
       ++i) {  // the ends and their neighbours, one unit in the last place after the other
    for (const double gap : {gap_above, gap_below}) {
      const double back = force.gap_of_impulse(force.impulse(gap));
      EXPECT_NEAR(back / gap, 1, round_off(fit, force, gap)) << "gap " << gap;
      EXPECT_LE(back, to);
      EXPECT_GE(back, force.interval()[0]);
    }
    gap_above = std::nextafter(gap_above, to);
    gap_below = std::nextafter(gap_below, from);
  }
}

INSTANTIATE_TEST_SUITE_P(Impulse, Inverse, ::testing::ValuesIn(samples()),
                         [](const auto& tested) { return tested.param.name; });

TEST(ImpulseInverse, StaysInsideAnyIntervalItIsGiven) {
  // exp(ln q) is not always q: the ends of many intervals, where a rounding outwards would leave
  // them.
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> logarithm(-9, 0);
  for (int i = 0; i < 2000; ++i) {
    const double from = std::exp(logarithm(random));
    const double to = from * (2 + std::exp(logarithm(random)));
    const LubricationForce force(fitting::planted_fit({{"1/q", 56.5}, {"1", 10}}, from, to));
    for (const double gap : {from, std::nextafter(from, to), std::nextafter(to, from), to}) {
      double back = 0;
      ASSERT_NO_THROW(back = force.gap_of_impulse(force.impulse(gap)))
          << "[" << from << ", " << to << "]";
      ASSERT_GE(back, from);
      ASSERT_LE(back, to);
    }
  }
}

TEST(ImpulseInverse, IsMonotonicAcrossTheLowerEnd) {
  const LubricationForce force(
      fitting::fit_force_table(fitting::exact_drag_table(fitting::fifty_gaps(), {-1}, 3, 1),
                               "asymptotic", Weights::kRelative),
      {BelowInterval::kLubricationLimit});
  const double end = force.impulse(1e-3);
  double last = 0;
  for (int i = -50; i <= 50; ++i) {
    // Steps of 1e-9 of Gamma move q by 7e-9 of itself: far above round-off.
    const double gap = force.gap_of_impulse(end * (1 - i * 1e-9));
    EXPECT_GT(gap, last) << i;
    last = gap;
  }
}

TEST(ImpulseInverse, NamesTheIntervalItLeaves) {
  const LubricationForce force(fitting::planted_fit({{"1/q", 56.5}}, 1e-3, 2));
  EXPECT_THAT(bad_input([&] { force.gap_of_impulse(force.impulse(1e-3) - 1); }),
              Names("0.001", "2"));
  EXPECT_THAT(bad_input([&] { force.gap_of_impulse(force.impulse(2) + 1); }), Names("0.001", "2"));
  const LubricationForce limit(fitting::planted_fit({{"1/q", 56.5}}, 1e-3, 2),
                               {BelowInterval::kLubricationLimit});
  EXPECT_THAT(bad_input([&] { limit.gap_of_impulse(limit.impulse(2) + 1); }), Names("0.001", "2"));
}

TEST(ImpulseInverse, RefusesWhatIsNoImpulse) {
  const LubricationForce force(fitting::planted_fit({{"1/q", 56.5}}, 1e-3, 2),
                               {BelowInterval::kLubricationLimit});
  EXPECT_THROW(force.gap_of_impulse(std::numeric_limits<double>::quiet_NaN()), Error);
  EXPECT_THROW(force.gap_of_impulse(std::numeric_limits<double>::infinity()), Error);
}

TEST(ImpulseInverse, SaysThatAFilmIsTooThinForADouble) {
  const LubricationForce force(fitting::planted_fit({{"1/q", 1}}, 1e-3, 2),
                               {BelowInterval::kLubricationLimit});
  failure(ErrorKind::kNotConverged, [&] { force.gap_of_impulse(-1000); });
}

TEST(ImpulseInverse, GivesTheLecturesMinimalGap) {
  // Without inertia Gamma(q_min) = Gamma(q0) + impulse of the push, -200 for 2 units of time
  // (docs/theory.md, section 3), on the exact drag. The fit is within 6e-6 of the drag everywhere,
  // hence Gamma too, and dq/q = dGamma/k = 6e-6 * 400/56.5 at worst; the residual changes sign, so
  // 1e-5 holds.
  const LubricationForce force(
      fitting::fit_force_table(fitting::exact_drag_table(fitting::fifty_gaps(), {-1}, 3, 1),
                               "asymptotic", Weights::kRelative));
  constexpr double kExact = 2.97084661e-3;
  EXPECT_NEAR(force.gap_of_impulse(force.impulse(1) - 400), kExact, 1e-5 * kExact);
}

}  // namespace
}  // namespace viscontact::lubrication
