// The work of the walls from the stresses that positions and forces give, against the dissipation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

TEST(StepEnergy, OfTheWallsIsTheDissipation) {
  constexpr double period = 8.5, rate = 0.5;
  const std::vector<StepKind> kinds{
      {PairTerms::kNearContact, 1e-3, 0, 0},   {PairTerms::kNearContact, 0, 0, 0},
      {PairTerms::kNearContact, 0, 1e-2, 0.3}, {PairTerms::kNearContact, 1e-3, 1e-3, 1},
      {PairTerms::kTables, 0, 0, 0},           {PairTerms::kTables, 0, 1e-2, 0},
      {PairTerms::kTables, 0, 1e-2, 0.5},      {PairTerms::kNone, 0, 0, 0},
      {PairTerms::kNone, 0, 0, 0.3},
  };
  for (const auto& kind : kinds) {
    SCOPED_TRACE(testing::PrintToString(kind));
    Random random(31);
    auto setting = sheared_cube(period, 0, kind);
    setting.lubrication->gradient = {Vector{rate, 0, 0}, Vector{0, -rate, 0}, Vector{}};
    setting.time_step = 0.01 / rate;
    SuspensionSimulation simulation(setting,
                                    random_spheres(period, 0, two_sizes(26), 0.011, random), 1);
    std::size_t contacts = 0;
    for (int n = 0; n < 50; ++n) {
      ASSERT_TRUE(simulation.step(100).converged);
      const auto& found = simulation.rheology();
      contacts = std::max(contacts, found.contacts);
      // In a planar extension sigma:E is rate times the first normal stress difference, which is
      // over 2 rate times the viscosity of the fluid. Its error is of the order of the residual of
      // the motions, in the root of the power: 3e-9, and 1e-7 without films and friction.
      const double residual = kind.pairs == PairTerms::kNone && kind.friction == 0 ? 1e-7 : 3e-9;
      const double work = 2 * rate * rate * (found.n1 - 2) * std::pow(period, 3);
      EXPECT_NEAR(work, found.dissipation, 3.3 * residual * found.dissipation);
    }
    const bool has_contacts =
        kind.regularisation > 0 || kind.roughness > 0 || kind.pairs == PairTerms::kNone;
    EXPECT_EQ(contacts > 2, has_contacts);
  }
}

}  // namespace
}  // namespace viscontact::particles
