// Frames with rotation, images and spheres on an axis, and flows, are read as they were written.
#include "viscontact/particle_runs/io/vtk.hpp"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/vtk/flow_vtk.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;

class VtkFile : public ::testing::Test {
 protected:
  VtpContent frame(const Particles& p, const std::vector<CurrentContact>& contacts) const {
    return read_vtp(folder_.file("frame.vtp", write_vtp(p, contacts)), p.dimension);
  }
  TemporaryFolder folder_;
};

TEST_F(VtkFile, OfDiscsInAPeriodicFluidHasRotationAndImages) {
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 1, 1);
  add_particle(state, {3, 4, 0}, 1, 1);
  auto& p = state.particles;
  p.angles = {0.5, 1.0 / 3};
  p.angular_velocities = {-1, 2};
  p.cell = {{0, 0}, {4, 5}};
  const auto content = frame(p, {{0, 1, 0.1, -1, 0, -1}, {0, 1, 0.2, 0, 0, 0}, {-2, 1, 0, -3, 0}});
  EXPECT_EQ(content.positions, p.positions);
  EXPECT_EQ(content.angles, p.angles);
  EXPECT_EQ(content.angular_velocities, p.angular_velocities);
  ASSERT_EQ(content.contacts.size(), 3U);
  EXPECT_EQ(content.contacts[0].image, -1);
  EXPECT_EQ(content.contacts[0].gap, 0.1);
  EXPECT_EQ(content.contacts[1].image, 0);
  EXPECT_EQ(content.contacts[2].first, -2);
  EXPECT_EQ(content.contacts[2].image, 0);
}

TEST_F(VtkFile, OfAStrainedCellHasItsPeriods) {
  State state = no_particles(3);
  add_particle(state, {1, 2, 3}, 1, 1);
  state.particles.cell = {{0, 0, 0}, {4, 4, 4}};
  EXPECT_FALSE(frame(state.particles, {}).periods);
  const std::array<Vector, 3> periods = {Vector{1.0 / 3, 2, 3}, Vector{4, 5, 6},
                                         Vector{7, 8, 1e-9}};
  state.particles.cell.vectors = periods;
  EXPECT_EQ(frame(state.particles, {}).periods, periods);
  EXPECT_THAT(write_vtp(state.particles, {}), HasSubstr("NumberOfTuples=\"3\""));
}

TEST_F(VtkFile, OfAShearedSuspensionHasItsPeriods) {
  State state = no_particles(3);
  add_particle(state, {1, 2, 3}, 1, 1);
  auto& cell = state.particles.cell;
  cell = {{0, 0, 0}, {4, 5, 0}};
  cell.offset = 1.0 / 3;
  // The third axis has no period.
  const std::array<Vector, 3> periods = {Vector{4, 0, 0}, Vector{1.0 / 3, 5, 0}, Vector{}};
  EXPECT_EQ(frame(state.particles, {}).periods, periods);
}

TEST_F(VtkFile, WithoutAFluidHasNoRotation) {
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 1, 1);
  const auto text = write_vtp(state.particles, {});
  EXPECT_THAT(text, ::testing::Not(HasSubstr("angle")));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("image")));
  EXPECT_TRUE(frame(state.particles, {}).angles.empty());
}

TEST_F(VtkFile, HasTheMassesIfThereAreAny) {
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 1, 0);
  EXPECT_THAT(write_vtp(state.particles, {}), ::testing::Not(HasSubstr("\"mass\"")));
  state.particles.masses = {3};
  EXPECT_THAT(write_vtp(state.particles, {}), HasSubstr("Name=\"mass\""));
}

TEST_F(VtkFile, OfSpheresOnAnAxisHasThemOnZ) {
  State state = no_particles(1);
  add_particle(state, {3, 0, 0}, 1, 1);
  add_particle(state, {6, 0, 0}, 1, 1);
  const auto content = frame(state.particles, {{0, 1, 1, 0, 0}});
  EXPECT_EQ(content.positions, (std::vector<double>{3, 6}));
  const auto in_space = read_vtp(folder_.path() / "frame.vtp", 3);
  EXPECT_EQ(in_space.positions, (std::vector<double>{0, 0, 3, 0, 0, 6}));
}

FlowField small_flow() {
  FlowField flow;
  flow.x = {0, 1, 0, 0.5, 0.5, 0, 1};
  flow.y = {0, 0, 1, 0, 0.5, 0.5, 1};
  flow.velocity_x = {1, 2, 3, 4, 5, 6, 1.0 / 3};
  flow.velocity_y = {-1, 0, 1, 0, 0, 2, 4};
  flow.pressure = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 1e-300};
  flow.triangles = {{0, 1, 2, 3, 4, 5}, {1, 6, 2, 3, 0, 4}};
  return flow;
}

class FlowFile : public VtkFile, public ::testing::WithParamInterface<int> {};

TEST_P(FlowFile, IsReadAsItWasWritten) {
  const auto flow = small_flow();
  const auto text = write_flow(flow, GetParam() == 1);
  EXPECT_THAT(text, HasSubstr("<Piece NumberOfPoints=\"7\" NumberOfCells=\"2\">"));
  const auto again = read_flow(folder_.file("flow.vtu", text));
  EXPECT_EQ(again.x, flow.x);
  EXPECT_EQ(again.y, flow.y);
  EXPECT_EQ(again.velocity_x, flow.velocity_x);
  EXPECT_EQ(again.velocity_y, flow.velocity_y);
  EXPECT_EQ(again.pressure, flow.pressure);
  EXPECT_EQ(again.triangles, flow.triangles);
}

INSTANTIATE_TEST_SUITE_P(PlaneAndAxis, FlowFile, ::testing::Values(2, 1));

TEST_F(VtkFile, OfAFlowThatWasCutShortIsRefused) {
  const auto text = write_flow(small_flow());
  for (const auto size : {text.size() / 3, text.size() / 2, text.size() - 1})
    EXPECT_THAT(bad_input([&] { read_flow(folder_.file("flow.vtu", text.substr(0, size))); }),
                IsAt("flow.vtu"));
  auto flow = small_flow();
  flow.triangles[1][3] = 7;
  EXPECT_THAT(bad_input([&] { read_flow(folder_.file("flow.vtu", write_flow(flow))); }),
              IsAt("flow.vtu"));
}

}  // namespace
}  // namespace viscontact::particles
