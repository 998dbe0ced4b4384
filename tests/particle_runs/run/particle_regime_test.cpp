// Regimes of runs of many particles.
#include "viscontact/particle_runs/run/particle_regime.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tests/common/temporary_folder.hpp"

namespace viscontact::particles {
namespace {

TEST(ParticleRegime, KnowsTheFilmOfARoundWall) {
  const TemporaryFolder folder;
  const auto c = read_particles_case(folder.file(
      "case.toml",
      "title = \"A disc in a disc\"\n[space]\ndimension = 2\n[domain]\ndisc = { centre = "
      "[0.0, 0.0], radius = 4.0 }\n[viscous_contact]\nviscosity = 1.0\nroughness = "
      "1e-3\ntime_step = 0.1\nend_time = 1.0\n[[particle]]\ncentre = [0.0, 0.0]\n"
      "radius = 1.0\nmass = 1.0\n"));
  const auto& film = c.setting.laws.film;
  const double at_plane = film.lowest_gamma(1, std::numeric_limits<double>::infinity()),
               at_wall = film.lowest_gamma(1, -4);
  ASSERT_LT(at_wall, at_plane);
  const auto touched_at = [&](double gamma) {
    State state;
    state.particles = c.particles;
    Pair wall;
    wall.first = -1;
    wall.second = 0;
    wall.gamma = gamma;
    state.walls = {wall};
    ParticleRegime regime;
    regime.add(c, state, true);
    return regime.have_solids_touched;
  };
  EXPECT_FALSE(touched_at((at_wall + at_plane) / 2));
  EXPECT_TRUE(touched_at(at_wall));
}

}  // namespace
}  // namespace viscontact::particles
