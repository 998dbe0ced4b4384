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
  const std::vector<StepKind> kinds{{PairTerms::kNearContact, 1e-3, 0, 0},
                                    {PairTerms::kTables, 0, 1e-2, 0},
                                    {PairTerms::kTables, 0, 1e-2, 0.5},
                                    {PairTerms::kNearContact, 1e-3, 1e-3, 1},
                                    {PairTerms::kNone, 0, 0, 0.3}};
  for (const auto& kind : kinds) {
    SCOPED_TRACE(&kind - kinds.data());
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
      // the motions, 3e-9 in the root of the power.
      const double work = 2 * rate * rate * (found.n1 - 2) * std::pow(period, 3);
      EXPECT_NEAR(work, found.dissipation, 1e-8 * found.dissipation);
    }
    EXPECT_GT(contacts, 2U);
  }
}

}  // namespace
}  // namespace viscontact::particles
