// Particles in a fluid and on an axis as CSV files: columns, numbers that read back, and refusals.
#include "viscontact/particle_runs/io/particle_file.hpp"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <array>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

using ::testing::AllOf;

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

Particles discs_in_fluid() {
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 0.5, 0, {-0.1, 1.0 / 3, 0});
  add_particle(state, {4, 5, 0}, 0.25, 3);
  state.particles.angles = {0.7, -1};
  state.particles.angular_velocities = {2, 1.0 / 7};
  return state.particles;
}

class FluidParticleFile : public ::testing::Test {
 protected:
  Particles read(const std::string& text, int dimension, bool in_fluid) const {
    return read_particles(folder_.file("particles.csv", text), dimension, in_fluid).particles;
  }
  TemporaryFolder folder_;
};

TEST_F(FluidParticleFile, OfDiscsHasRotationAndForces) {
  const auto p = discs_in_fluid();
  const std::vector<double> forces = {10, 20, 30, 40, 50, 60.5}, errors = {1, 1, 2, 3, 3, 0.5};
  const auto text = write_particles(p, FluidForces{forces, errors});
  EXPECT_THAT(text, StartsWith("# rows: 2\n"));
  EXPECT_THAT(text, EndsWith("\n0,1,2,-0.1,0.3333333333333333,0.5,0,0.7,2,10,20,30,1,2\n"
                             "1,4,5,0,0,0.25,3,-1,0.14285714285714285,40,50,60.5,3,0.5\n"));
  const auto again = read(text, 2, true);
  EXPECT_EQ(again.positions, p.positions);
  EXPECT_EQ(again.velocities, p.velocities);
  EXPECT_EQ(again.masses, p.masses);
  EXPECT_EQ(again.angles, p.angles);
  EXPECT_EQ(again.angular_velocities, p.angular_velocities);
  EXPECT_TRUE(again.inertias.empty());
}

TEST_F(FluidParticleFile, OfSpheresOnAnAxisHasOneComponent) {
  State state = no_particles(1);
  add_particle(state, {3, 0, 0}, 1, 0, {-0.5, 0, 0});
  const std::vector<double> forces = {-9}, errors = {0.25};
  const auto text = write_particles(state.particles, FluidForces{forces, errors});
  EXPECT_EQ(text,
            "# rows: 1\nid,z,vz,radius,mass,fluid_force_z,fluid_force_error_estimate\n"
            "0,3,-0.5,1,0,-9,0.25\n");
  const auto again = read(text, 1, true);
  EXPECT_EQ(again.dimension, 1);
  EXPECT_EQ(again.positions, std::vector<double>{3});
  EXPECT_EQ(again.velocities, std::vector<double>{-0.5});
  EXPECT_EQ(again.masses, std::vector<double>{0});
  EXPECT_TRUE(again.angles.empty());
}

TEST_F(FluidParticleFile, HasEmptyFieldsForWhatIsNotKnown) {
  // Before the first step, and after a step without an estimate. A case can read the file.
  const auto p = discs_in_fluid();
  const std::vector<double> forces = {10, 20, 30, 40, 50, 60.5};
  const auto no_step = write_particles(p, FluidForces{});
  EXPECT_THAT(no_step, HasSubstr("0.5,0,0.7,2,,,,,\n"));
  EXPECT_EQ(read(no_step, 2, true).angles, p.angles);
  const auto no_estimate = write_particles(p, FluidForces{forces, {}});
  EXPECT_THAT(no_estimate, HasSubstr("0.5,0,0.7,2,10,20,30,,\n"));
  EXPECT_EQ(read(no_estimate, 2, true).angles, p.angles);
}

TEST_F(FluidParticleFile, WithoutRotationBeginsAtAngle0) {
  const auto p = read("x,y,radius,mass\n1,2,1,0\n", 2, true);
  EXPECT_EQ(p.angles, std::vector<double>{0});
  EXPECT_EQ(p.angular_velocities, std::vector<double>{0});
}

TEST_F(FluidParticleFile, WithoutAFluidHasTheRotationOfParticlesThatTurn) {
  auto discs = read("x,y,radius,mass,angular_velocity\n1,2,1,1,0.5\n", 2, false);
  EXPECT_EQ(discs.angular_velocities, std::vector<double>{0.5});
  EXPECT_EQ(discs.angles, std::vector<double>{0});
  EXPECT_THAT(write_particles(discs), EndsWith("\n0,1,2,0,0,1,1,0,0.5\n"));
  auto spheres = read("x,y,z,radius,mass,angular_velocity_z\n1,2,3,1,1,0.5\n", 3, false);
  EXPECT_EQ(spheres.angular_velocities, (std::vector<double>{0, 0, 0.5}));
  EXPECT_THAT(write_particles(spheres), EndsWith("\n0,1,2,3,0,0,0,1,1,0,0,0.5\n"));
  EXPECT_TRUE(read("x,y,radius,mass\n1,2,1,1\n", 2, false).angular_velocities.empty());
}

TEST_F(FluidParticleFile, StaysAsItWasWithoutAFluid) {
  auto p = discs_in_fluid();
  p.angles = p.angular_velocities = {};
  EXPECT_THAT(write_particles(p),
              EndsWith("\n0,1,2,-0.1,0.3333333333333333,0.5,0\n1,4,5,0,0,0.25,3\n"));
  EXPECT_THAT(bad_input([&] { read("x,y,radius,mass,fluid_torque\n1,2,1,1,0\n", 2, false); }),
              IsAt("particles.csv:1", "fluid_torque"));
  EXPECT_THAT(bad_input([&] { read(",x,y,radius,mass\n0,1,2,1,1\n", 2, false); }),
              IsAt("particles.csv:1"));
  EXPECT_THAT(bad_input([&] { read("x,y,radius,mass\n1,2,1,0\n", 2, false); }),
              IsAt("particles.csv:2", "mass"));
}

TEST_F(FluidParticleFile, IsRefusedWithTheLine) {
  EXPECT_THAT(bad_input([&] { read("x,y,radius,mass\n1,2,1,-1\n", 2, true); }),
              AllOf(IsAt("particles.csv:2", "mass"), Names("-1")));
  EXPECT_THAT(bad_input([&] { read("x,y,radius,mass\n1,2,0,1\n", 2, true); }),
              IsAt("particles.csv:2", "radius"));
  EXPECT_THAT(bad_input([&] { read("z,x,radius,mass\n1,2,1,1\n", 1, true); }),
              IsAt("particles.csv:2"));
  EXPECT_THAT(bad_input([&] { read("z,radius,mass,spin\n1,2,1,1\n", 1, true); }),
              IsAt("particles.csv:1", "spin"));
  EXPECT_THAT(bad_input([&] { read("x,y,radius,mass,fluid_force_z\n1,2,1,1,0\n", 2, true); }),
              IsAt("particles.csv:1", "fluid_force_z"));
}

TEST_F(FluidParticleFile, OfEllipsesIsRefusedByItsColumn) {
  auto particles = discs_in_fluid();
  particles.shapes = {Shape::ellipse(0.5, 0.25), Shape::disc(0.25)};
  const auto text = write_particles(particles, FluidForces{{}, {}});
  EXPECT_THAT(bad_input([&] { read(text, 2, true); }), IsAt("particles.csv:2", "semi_axis_1"));
}

TEST_F(FluidParticleFile, NamesTheMissingComponentOfTheVelocity) {
  EXPECT_THAT(bad_input([&] { read("# a\nx,y,radius,mass,vx,vz\n1,2,1,1,5,\n", 2, false); }),
              IsAt("particles.csv:2"));
  EXPECT_THAT(bad_input([&] { read("x,y,z,radius,mass,vy,vz\n1,2,3,1,1,5,6\n", 3, false); }),
              IsAt("particles.csv:1"));
  EXPECT_THAT(bad_input([&] { read("z,radius,mass,vx\n1,1,1,\n", 1, false); }),
              IsAt("particles.csv:1"));
  EXPECT_EQ(read("x,y,radius,mass,vx,vy,vz\n1,2,1,1,5,6,\n", 2, false).velocities,
            (std::vector<double>{5, 6}));
}

TEST_F(FluidParticleFile, MayHaveAByteOrderMarkBeforeAComment) {
  const std::string mark = "\xEF\xBB\xBF", table = "x,y,radius,mass\n1,2,1,1\n";
  EXPECT_EQ(read(mark + table, 2, false).count(), 1U);
  EXPECT_EQ(read(mark + "# a comment\n" + table, 2, false).count(), 1U);
}

// To open a pipe a second time would wait forever for another writer.
TEST_F(FluidParticleFile, MayBeAPipe) {
  const auto pipe = folder_.path() / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { std::ofstream(pipe) << "x,y,radius,mass,spin\n1,2,1,1,1\n"; });
  EXPECT_THAT(bad_input([&] { read_particles(pipe, 2, false); }), Names("spin"));
  writer.join();
}

TEST_F(FluidParticleFile, OfTheMotionHasARowForEachParticle) {
  auto p = discs_in_fluid();
  p.ids = {7, 3};
  EXPECT_EQ(motion_rows(0.1, p),
            "0.1,7,1,2,0.7,-0.1,0.3333333333333333,2\n"
            "0.1,3,4,5,-1,0,0,0.14285714285714285\n");
  State state = no_particles(1);
  add_particle(state, {3, 0, 0}, 1, 0, {-0.5, 0, 0});
  EXPECT_EQ(motion_rows(2, state.particles), "2,0,3,-0.5\n");
}

TEST_F(FluidParticleFile, OfTheMotionHasTheColumnsThatParticlesHave) {
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 1, 1, {-0.5, 3, 0});
  EXPECT_EQ(motion_rows(2, state.particles), "2,0,1,2,-0.5,3\n");
  state = no_particles(3);
  add_particle(state, {1, 2, 3}, 1, 1, {4, 5, 6});
  EXPECT_EQ(motion_rows(2, state.particles), "2,0,1,2,3,4,5,6\n");
  add_rotation(state.particles);
  state.particles.angular_velocities = {7, 8, 9};
  EXPECT_EQ(motion_rows(2, state.particles), "2,0,1,2,3,4,5,6,7,8,9\n");
}

}  // namespace
}  // namespace viscontact::particles
