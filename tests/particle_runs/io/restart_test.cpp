// Restart files that are read and those that are refused.
#include "viscontact/particle_runs/io/restart.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact::particles {
namespace {

using ::testing::HasSubstr;

/// A disc on a plane whose film pulls.
State disc_on_plane(double gamma) {
  State state = no_particles(2);
  add_particle(state, {0, 1, 0}, 1, 2, {0.5, 0, 0});
  state.walls.push_back({-1, 0, gamma, -0.25, 1e-9});
  state.time = 3;
  return state;
}

class RestartFile : public ::testing::Test {
 protected:
  State read(const std::string& text) const {
    return read_restart(folder_.file("restart.bin", text));
  }
  TemporaryFolder folder_;
};

TEST_F(RestartFile, IsReadAsItWasWritten) {
  const auto state = read(write_restart(disc_on_plane(-0.75)));
  EXPECT_EQ(state.time, 3);
  EXPECT_EQ(state.particles.masses, std::vector<double>{2});
  ASSERT_EQ(state.walls.size(), 1U);
  EXPECT_EQ(state.walls[0].gamma, -0.75);
  EXPECT_EQ(state.walls[0].impulse, -0.25);
  EXPECT_EQ(state.walls[0].gamma_error, 1e-9);
}

TEST_F(RestartFile, HasTheFlowOfAFluidWithInertia) {
  auto state = disc_on_plane(-0.75);
  state.flow = {'a', '\0', '\n'};
  state.step_before = 0.25;
  const auto back = read(write_restart(state));
  EXPECT_EQ(back.flow, state.flow);
  EXPECT_EQ(back.step_before, 0.25);
  EXPECT_EQ(back.walls, state.walls);
}

TEST_F(RestartFile, HasTheShearOfASuspension) {
  auto state = disc_on_plane(-0.75);
  state.shear = {.strain = 7.5, .rate = -1, .offset = 0.25, .net_strain = -2};
  state.shear.gradient = {Vector{0, -3, 0}, Vector{}, Vector{0.5, 0, 0}};
  state.shear.periods = {Vector{1, 2, 3}, Vector{0, 4, 0}, Vector{0, 0, 5}};
  EXPECT_EQ(read(write_restart(state)).shear, state.shear);
  state.shear.offset = std::numeric_limits<double>::infinity();
  EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
}

TEST_F(RestartFile, HasThePositionsBeforeAStepOfMembranes) {
  auto state = disc_on_plane(-0.75);
  state.earlier_positions = {0.5, 2};
  const auto text = write_restart(state);
  EXPECT_EQ(read(text).earlier_positions, state.earlier_positions);
  state.earlier_positions = {0.5};
  EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
}

TEST_F(RestartFile, HasWhatSourcesHaveDone) {
  auto state = disc_on_plane(-0.75);
  state.sources = {{.poured = 1, .begin = 2, .begin_of_case = 0.5, .rate = 3, .seed = 4},
                   {.poured = 0, .begin = 7, .begin_of_case = 7, .rate = 0.1, .species = ~0ULL}};
  const auto text = write_restart(state);
  EXPECT_EQ(read(text).sources, state.sources);
  for (const int poured : {-1, 1}) {  // the disc comes from the first source
    state.sources[1].poured = poured;
    EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
  }
}

TEST_F(RestartFile, HasTheImpactsOfTheLastStep) {
  auto state = disc_on_plane(-0.75);
  state.earlier_step = 0.1;
  state.impact_impulses = {{-1, {0.1, 1.0 / 3, 0}, {0, 1, 0}}, {0, {-2, 0, 0}, {1.0 / 7, 0, 0}}};
  const auto text = write_restart(state);
  const auto again = read(text);
  ASSERT_EQ(again.impact_impulses.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(again.impact_impulses[k].first, state.impact_impulses[k].first);
    EXPECT_EQ(again.impact_impulses[k].impulse, state.impact_impulses[k].impulse);
    EXPECT_EQ(again.impact_impulses[k].branch, state.impact_impulses[k].branch);
  }
  EXPECT_EQ(write_restart(again), text);
  const auto refused = [&](const std::function<void(State&)>& change) {
    auto other = state;
    change(other);
    EXPECT_THAT(bad_input([&] { read(write_restart(other)); }), IsAt("restart.bin"));
  };
  refused([](State& other) { other.impact_impulses[1].first = 1; });
  refused([](State& other) { other.impact_impulses[0].impulse[1] = std::nan(""); });
  refused([](State& other) { other.impact_impulses[0].branch[0] = INFINITY; });
  refused([](State& other) { other.earlier_step = 0; });
}

TEST_F(RestartFile, SaysWhichEndOfAPlateIsAtAnObstacle) {
  auto state = disc_on_plane(-0.75);
  state.walls.push_back(state.walls[0]);
  state.walls[1].place = 1;
  const auto text = write_restart(state);
  EXPECT_EQ(read(text).walls, state.walls);
  state.walls[1].place = 64;
  EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
}

TEST_F(RestartFile, OfBodiesHasTheirMotion) {
  State state = no_particles(3);
  add_particle(state, {0, 1, 0}, 1, 2, {0.5, 0, 0});
  add_particle(state, {3, 1, 0.5}, 1, 1, {0.5, -1, 0});
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{0, 1}});
  state.link_forces = {1.0 / 3, -2};
  const auto again = read(write_restart(state));
  ASSERT_EQ(again.particles.bodies.count(), 1U);
  const auto &body = again.particles.bodies.bodies[0], &before = state.particles.bodies.bodies[0];
  EXPECT_EQ(body.centre, before.centre);
  EXPECT_EQ(body.velocity, before.velocity);
  EXPECT_EQ(body.orientation, before.orientation);
  EXPECT_EQ(body.angular_momentum, before.angular_momentum);
  EXPECT_EQ(body.angular_velocity, before.angular_velocity);
  EXPECT_EQ(again.link_forces, state.link_forces);
}

TEST_F(RestartFile, OfAFluidIsReadAsItWasWritten) {
  State state = no_particles(2);
  add_particle(state, {0, 1, 0}, 1, 2, {0.5, 0, 0});
  add_particle(state, {3, 1, 0}, 1, 0);
  state.particles.angles = {0.1, -2};
  state.particles.angular_velocities = {3, 0.7};
  state.particles.inertias = {1, 0};
  state.pairs = {{0, 1, -0.5, 0.25, 0, 0}, {0, 1, -0.25, 0, 1e-9, -4}};
  state.earlier_velocities = {1, 2, 3, 4, 5, 1.0 / 3};
  state.earlier_forces = {6, 5, 4, 3, 2, 1.0 / 7};
  state.earlier_step = 0.1;
  const auto again = read(write_restart(state));
  EXPECT_EQ(again.particles.angles, state.particles.angles);
  EXPECT_EQ(again.particles.angular_velocities, state.particles.angular_velocities);
  EXPECT_EQ(again.particles.inertias, state.particles.inertias);
  EXPECT_EQ(again.pairs, state.pairs);
  EXPECT_EQ(again.earlier_velocities, state.earlier_velocities);
  EXPECT_EQ(again.earlier_forces, state.earlier_forces);
  EXPECT_EQ(again.earlier_step, 0.1);
  EXPECT_EQ(write_restart(again), write_restart(state));
}

TEST_F(RestartFile, OfFrictionHasWhatTheSolidsCarried) {
  State state = disc_on_plane(-0.5);
  PairMemory memory;
  memory.set_friction({0.125, 0, 0});
  memory[Remembered::kSolidLoad] = 1.0 / 3;
  state.memories.set(state.walls[0].memory, memory);
  const auto again = read(write_restart(state));
  EXPECT_EQ(again.memories.of(again.walls[0].memory), memory);
  state.memories.make(state.walls[0].memory)[Remembered::kSolidLoad] = -1;
  EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
}

TEST_F(RestartFile, OnAnAxisHasOneNumberForEachParticle) {
  State state = no_particles(1);
  add_particle(state, {2, 0, 0}, 1, 0, {-1, 0, 0});
  state.earlier_velocities = {0.5};
  const auto again = read(write_restart(state));
  EXPECT_EQ(again.particles.positions, std::vector<double>{2});
  EXPECT_EQ(again.earlier_velocities, std::vector<double>{0.5});
}

TEST_F(RestartFile, WithListsOfOtherLengthsIsRefused) {
  const auto refused = [&](const std::function<void(State&)>& change) {
    State state = disc_on_plane(-0.5);
    change(state);
    EXPECT_THAT(bad_input([&] { read(write_restart(state)); }), IsAt("restart.bin"));
  };
  refused([](State& state) { state.particles.angles = {1, 2}; });
  refused([](State& state) { state.particles.angles = {1}; });  // no angular velocity
  refused([](State& state) { state.particles.inertias = {1, 2}; });
  refused([](State& state) { state.earlier_velocities = {1, 2}; });
  refused([](State& state) { state.earlier_forces = {1, 2}; });
  refused([](State& state) { state.earlier_step = -1; });
  refused([](State& state) {
    state.flow = {'a'};
    state.step_before = -1;
  });
  refused([](State& state) {
    add_particle(state, {5, 5, 0}, 1, 1);
    state.pairs = {{0, 1, 0, 0, 0, kLargestImage + 1}};
  });
}

TEST_F(RestartFile, OfAnotherVersionIsRefused) {
  for (const auto* version : {"version 19", "version :", "version 17", "version 18x"}) {
    auto text = write_restart(disc_on_plane(-0.5));
    text.replace(text.find("version 18"), 10, version);
    EXPECT_THAT(bad_input([&] { read(text); }), IsAt("restart.bin"));
  }
}

TEST_F(RestartFile, WithoutAFiniteGammaIsRefused) {
  for (const double gamma :
       {std::numeric_limits<double>::quiet_NaN(), 0.5, -std::numeric_limits<double>::infinity()})
    EXPECT_THAT(bad_input([&] { read(write_restart(disc_on_plane(gamma))); }), IsAt("restart.bin"));
}

}  // namespace
}  // namespace viscontact::particles
