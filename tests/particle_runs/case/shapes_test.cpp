// Ellipses and plates in cases without a fluid.
#include <gmock/gmock.h>

#include <numbers>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/particle_runs/case/particles_case.hpp"

namespace viscontact::particles {
namespace {

class DryShapes : public ::testing::Test {
 protected:
  /// A case with a disc and a particle with these lines, of which the first is line 14, and then
  /// these `sections`.
  ParticlesCase read(const std::string& particle, const std::string& restitution = "0.0",
                     const std::string& sections = "") const {
    return read_particles_case(folder_.file("case.toml", R"(title = "Shapes"
[space]
dimension = 2
[viscous_contact]
time_step = 0.1
end_time = 1.0
gamma_min = 0.0
restitution = )" + restitution + R"(
[[particle]]
centre = [0.0, 0.0]
radius = 1.0
mass = 2.0
[[particle]]
)" + particle + "\ncentre = [3.0, 0.0]\n" + sections));
  }
  Error refused(const std::string& particle, const std::string& restitution = "0.0",
                const std::string& sections = "") const {
    return bad_input([&] { read(particle, restitution, sections); });
  }
  TemporaryFolder folder_;
};

TEST_F(DryShapes, TurnAndHaveTheMomentOfTheirShape) {
  const auto ellipse = read("semi_axes = [1.5, 0.5]\ndensity = 2.0\nangle = 0.3").particles;
  const double mass = 2 * std::numbers::pi * 1.5 * 0.5;
  EXPECT_EQ(ellipse.shapes[0], Shape::disc(1));
  EXPECT_EQ(ellipse.shapes[1], Shape::ellipse(1.5, 0.5));
  EXPECT_EQ(ellipse.radii[1], 1.5);
  EXPECT_EQ(ellipse.angles, (std::vector{0.0, 0.3}));
  EXPECT_DOUBLE_EQ(ellipse.masses[1], mass);
  EXPECT_DOUBLE_EQ(ellipse.inertias[0], 1);
  EXPECT_DOUBLE_EQ(ellipse.inertias[1], mass * (1.5 * 1.5 + 0.5 * 0.5) / 4);
  const auto plate = read("radius = 0.1\nlength = 2.0\nmass = 3.0").particles;
  EXPECT_EQ(plate.shapes[1], Shape::plate(1, 0.1));
  EXPECT_DOUBLE_EQ(plate.inertias[1], Shape::plate(1, 0.1).inertia(3));
  EXPECT_TRUE(plate.turn());
}

TEST_F(DryShapes, OverlapByTheirOutlines) {
  // The circle around the ellipse overlaps the disc, the ellipse does not.
  EXPECT_NO_THROW(read("semi_axes = [0.9, 2.5]\nmass = 1.0"));
  EXPECT_THAT(refused("semi_axes = [2.5, 0.9]\nmass = 1.0"), IsAt("case.toml:13"));
}

TEST_F(DryShapes, DoNotRebound) {
  EXPECT_THAT(refused("semi_axes = [1.0, 0.5]\nmass = 1.0", "0.5"),
              IsAt("case.toml:14", "particle[1].semi_axes"));
  EXPECT_THAT(refused("radius = 0.1\nlength = 1.0\nmass = 1.0", "0.5"),
              IsAt("case.toml:15", "particle[1].length"));
}

TEST_F(DryShapes, AreNoBeadsOfMembranes) {
  EXPECT_THAT(refused("semi_axes = [1.0, 0.5]\nmass = 1.0", "0.0",
                      "[[particle]]\ncentre = [1.5, 3.0]\nradius = 0.5\nmass = 1.0\n"
                      "[[membrane]]\nparticles = [0, 1, 2]\nbending_rigidity = 1.0\n"),
              IsAt("case.toml", "membrane[0].particles"));
}

TEST(ShapeInSpace, IsRefused) {
  const TemporaryFolder folder;
  const auto file = folder.file("case.toml", R"(title = "Space"
[space]
dimension = 3
[viscous_contact]
time_step = 0.1
end_time = 1.0
[[particle]]
centre = [0.0, 0.0, 0.0]
semi_axes = [1.0, 0.5]
mass = 2.0
)");
  EXPECT_THAT(bad_input([&] { read_particles_case(file); }),
              IsAt("case.toml:9", "particle[0].semi_axes"));
}

}  // namespace
}  // namespace viscontact::particles
