// The swimmer of three spheres as a direct simulation, beside the displacement that the table of
// resistances gives.
#include <gtest/gtest.h>

#include <string>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"

namespace viscontact {
namespace {

class DirectSwimmer : public ParticlesCommand {};

// The exact displacement is that of data/reference/swimmer.csv, in unbounded fluid; the cylinder of
// 200 radii changes it by less than 1e-4 of it. The rest is the error of the mesh, which falls with
// its fourth power, 0.06 % with 24 edges and so 0.3 % with 16, and that of 8 steps, 0.07 %.
TEST_F(DirectSwimmer, SwimsAsFarAsTheTableSays) {
  constexpr double kExact = 0.1598053403882;
  auto text = read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/swimmer/direct_simulation.toml");
  text = replaced(text, "every = 0.05", "every = 1.0");  // files of the first and last time only
  text = replaced(text, "\ntime_step = 0.05", "\ntime_step = 0.125");
  compute(replaced(text, "edges_per_particle = 12", "edges_per_particle = 16"));
  const auto places = column("final_particles.csv", "z");
  ASSERT_EQ(places.size(), 3U);
  // The arms are those of the start again.
  EXPECT_NEAR(places[2] - places[0], 12, 1e-9);
  EXPECT_NEAR((places[1] - 200) / kExact, 1, 0.005);
}

}  // namespace
}  // namespace viscontact
