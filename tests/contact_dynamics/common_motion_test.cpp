// Motion that all share brings nobody closer: it makes no list of pairs longer.
#include <gtest/gtest.h>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// Pairs in the list of a lattice of discs after some steps at a common velocity.
std::size_t pairs_at(double velocity) {
  State state = no_particles(2);
  for (int k = 0; k < 400; ++k) add_particle(state, {2.5 * (k % 20), 2.5 * (k / 20), 0}, 1, 1);
  for (std::size_t k = 0; k < state.particles.velocities.size(); k += 2)
    state.particles.velocities[k] = velocity;
  Setting setting;
  setting.time_step = 0.05;
  Simulation simulation(setting, state, 1);
  for (int step = 0; step < 20; ++step) simulation.step(100);
  return simulation.state().pairs.size();
}

TEST(CommonMotion, DoesNotLengthenTheList) {
  const auto at_rest = pairs_at(0);
  EXPECT_EQ(pairs_at(50), at_rest);
  EXPECT_EQ(pairs_at(5000), at_rest);
}

}  // namespace
}  // namespace viscontact::particles
