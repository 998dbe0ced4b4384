// The work of the walls from the stresses that positions and forces give, against the dissipation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

struct Kind {
  PairTerms pairs;
  double regularisation, roughness, friction;
};

TEST(StepEnergy, OfTheWallsIsTheDissipation) {
  constexpr double period = 8.5, rate = 0.5;
  const std::vector<Kind> kinds{{PairTerms::kNearContact, 1e-3, 0, 0},
                                {PairTerms::kTables, 0, 1e-2, 0},
                                {PairTerms::kTables, 0, 1e-2, 0.5},
                                {PairTerms::kNearContact, 1e-3, 1e-3, 1},
                                {PairTerms::kNone, 0, 0, 0.3}};
  for (const auto& kind : kinds) {
    SCOPED_TRACE(&kind - kinds.data());
    Random random(31);
    auto setting = sheared_cube(period, 0);
    auto& of = *setting.lubrication;
    of.pairs = kind.pairs;
    of.regularisation = kind.regularisation;
    of.roughness = kind.roughness;
    of.gradient = {Vector{rate, 0, 0}, Vector{0, -rate, 0}, Vector{}};
    if (kind.friction > 0) setting.laws.friction = FrictionLaw{kind.friction};
    if (kind.pairs == PairTerms::kNone) {
      setting.laws.film.viscosity = 1;
      setting.laws.film.roughness = 1e-3;
    }
    setting.time_step = 0.01 / rate;
    SuspensionSimulation simulation(setting,
                                    random_spheres(period, 0, two_sizes(26), 0.011, random), 1);
    std::size_t contacts = 0;
    for (int n = 0; n < 50; ++n) {
      ASSERT_TRUE(simulation.step(100).converged);
      const auto& found = simulation.rheology();
      contacts = std::max(contacts, found.contacts);
      // In a planar extension sigma:E is rate times the first normal stress difference, which is
      // over 2 rate times the viscosity of the fluid. It has the residual of the motions, 1e-5 in
      // the root of the power, and a tenth of this with friction; a residual of 1e-9 leaves 1e-9.
      const double work = 2 * rate * rate * (found.n1 - 2) * std::pow(period, 3);
      EXPECT_NEAR(work, found.dissipation, (kind.friction > 0 ? 3e-6 : 3e-5) * found.dissipation);
    }
    EXPECT_GT(contacts, 2U);
  }
}

}  // namespace
}  // namespace viscontact::particles
