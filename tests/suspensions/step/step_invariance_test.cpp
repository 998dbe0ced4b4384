// Ten steps in another order, mirrored, shifted and in other units.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPeriod = 8.5, kOffset = 1.7;
// Rounding errors of iterations, which ten steps multiply.
constexpr double kBar = 1e-9;

class StepInvariance : public testing::TestWithParam<StepKind> {
 protected:
  static Setting setting_of(double period, double offset) {
    auto of = sheared_cube(period, offset, GetParam());
    of.time_step = 0.02;
    return of;
  }
  static SuspensionSimulation moved(const Setting& of, const State& from) {
    SuspensionSimulation simulation(of, from, 1);
    for (int n = 0; n < 10; ++n) EXPECT_TRUE(simulation.step(1e300).converged);
    return simulation;
  }
  std::vector<RelativeMotion> motions(const SuspensionSimulation& of, const Setting& with) const {
    std::vector<RelativeMotion> result;
    for (std::size_t k = 0; k < 26; ++k) result.push_back(relative_motion(of, with, k));
    return result;
  }
  Random random{41};
  State state = random_spheres(kPeriod, kOffset, two_sizes(26), 0.006, random);
  Setting setting = setting_of(kPeriod, kOffset);
};

TEST_P(StepInvariance, OfTheOrderOfSpheres) {
  const auto order = shuffled(26);
  const auto here = moved(setting, state), there = moved(setting, reordered(state, order));
  std::vector<RelativeMotion> sorted;
  for (const auto k : order) sorted.push_back(relative_motion(here, setting, k));
  EXPECT_LT(largest_difference(sorted, motions(there, setting)), kBar);
  EXPECT_NEAR(here.rheology().viscosity, there.rheology().viscosity, kBar);
}

TEST_P(StepInvariance, OfAMirrorAcrossTheVorticity) {
  const auto behind = displaced(state, [](const Vector& x) {
    return Vector{x[0], x[1], kPeriod - x[2]};
  });
  const auto here = moved(setting, state);
  const auto there = moved(setting, behind);
  EXPECT_LT(largest_difference(motions(here, setting), mirrored(motions(there, setting))), kBar);
}

TEST_P(StepInvariance, OfTheOrigin) {
  const Vector shift{30, -20, 7};
  const auto start = displaced(state, [&](const Vector& x) { return x + shift; });
  auto shifted = setting;
  shifted.domain = BoxDomain{shift, shift + Vector{kPeriod, kPeriod, kPeriod}, {true, true, true}};
  const auto here = moved(setting, state);
  const auto there = moved(shifted, start);
  EXPECT_LT(largest_difference(motions(here, setting), motions(there, shifted)), kBar);
}

TEST_P(StepInvariance, OfUnits) {
  for (int trial = 0; trial < 3; ++trial) {
    const double length = random.decades(-5, 5), time = random.decades(-5, 5);
    const double mass = random.decades(-5, 5);
    auto other = setting_of(length * kPeriod, length * kOffset);
    other.lubrication->viscosity = mass / (length * time);
    if (GetParam().pairs == PairTerms::kNone) {
      other.laws.film.viscosity = other.lubrication->viscosity;
      *other.laws.film.roughness *= length;
    }
    other.lubrication->gradient[0][1] = 1 / time;
    other.time_step = 0.02 * time;
    const auto here = moved(setting, state), there = moved(other, scaled(state, length));
    EXPECT_LT(
        largest_difference(motions(here, setting), in_units(motions(there, other), length, time)),
        kBar);
    EXPECT_NEAR(here.rheology().viscosity, there.rheology().viscosity, kBar);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, StepInvariance,
                         testing::Values(StepKind{PairTerms::kNearContact, 1e-3, 0, 0},
                                         StepKind{PairTerms::kNearContact, 0, 0, 0},
                                         StepKind{PairTerms::kTables, 0, 5e-3, 0.3},
                                         StepKind{PairTerms::kTables, 0, 1e-3, 0.5},
                                         StepKind{PairTerms::kNone, 0, 0, 0}));

}  // namespace
}  // namespace viscontact::particles
