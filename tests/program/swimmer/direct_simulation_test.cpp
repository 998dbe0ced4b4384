// The swimmer of three spheres as a direct simulation, beside the displacement that the table of
// resistances gives.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/program/particles/particles_command.hpp"
#include "tests/program/sample_files.hpp"

namespace viscontact {
namespace {

class DirectSwimmer : public ParticlesCommand {
 protected:
  /// The displacement of the middle sphere in one stroke of the shipped case with this mesh [L].
  double displacement(int edges) {
    auto text = read_file(VISCONTACT_SOURCE_FOLDER "/data/cases/swimmer/direct_simulation.toml");
    text = replaced(text, "every = 0.05", "every = 1.0");  // files of the first and last time only
    text =
        replaced(text, "edges_per_particle = 12", "edges_per_particle = " + std::to_string(edges));
    const auto folder = out(std::to_string(edges));
    expect_done(run(put_case(text), folder));
    const auto places = matches_in(content(folder / "final_particles.csv"), "\n[0-9]+,([^,]+),", 1);
    EXPECT_EQ(places.size(), 3U);
    // The arms are those of the start again.
    EXPECT_NEAR(std::stod(places.at(2)) - std::stod(places.at(0)), 12, 1e-9);
    return std::stod(places.at(1)) - 200;
  }
};

// The exact displacement is that of data/reference/swimmer.csv, in unbounded fluid; the cylinder of
// 200 radii changes it by less than 1e-4 of it. The rest is the error of 20 steps and of the mesh,
// which falls with its fourth power.
TEST_F(DirectSwimmer, SwimsAsFarAsTheTableSays) {
  constexpr double kExact = 0.1598053403882;
  const double coarse = displacement(12), fine = displacement(24);
  EXPECT_NEAR(coarse / kExact, 1, 0.02);
  EXPECT_NEAR(fine / kExact, 1, 0.002);
  EXPECT_LT(std::abs(fine - kExact), std::abs(coarse - kExact) / 4);
}

}  // namespace
}  // namespace viscontact
