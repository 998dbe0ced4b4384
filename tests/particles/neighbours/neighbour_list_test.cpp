// The list of close pairs of a simulation: what is left of it where making it anew fails.
#include "viscontact/particles/neighbours/neighbour_list.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "tests/common/failure.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

TEST(NeighbourList, IsTheSameAsBeforeWhereAParticleMovesTooFarForItsCell) {
  ThreadPool pool(1);
  auto state = no_particles(2);
  state.particles.cell.lengths = {10, 10, 0};
  add_particle(state, {2, 5, 0}, 1, 1);
  add_particle(state, {4.1, 5, 0}, 1, 1);
  add_particle(state, {7, 5, 0}, 1, 1);
  const std::vector<double> none(6, 0.0);
  rebuild_neighbour_list(state, none, pool);
  ASSERT_TRUE(neighbour_list_is_valid(state, none, pool));
  ASSERT_EQ(state.pairs.size(), 1U);
  const auto skins = state.skins, listed_at = state.positions_at_listing;
  // A simulation that continues after an error, with particles at other places, must not take the
  // old pairs for those of the new places.
  state.particles.positions = {2, 5, 4.1, 8, 9, 5};
  // Relative to the mean, the first two move by a permitted distance, which makes their skins
  // longer.
  const std::vector<double> far = {0, 0, 0, 0, 5, 0};
  EXPECT_THAT(failure(ErrorKind::kNotConverged, [&] { rebuild_neighbour_list(state, far, pool); }),
              Names("2", "3.33"));
  EXPECT_EQ(state.skins, skins);
  EXPECT_EQ(state.positions_at_listing, listed_at);
  EXPECT_FALSE(neighbour_list_is_valid(state, none, pool));
}

}  // namespace
}  // namespace viscontact::particles
