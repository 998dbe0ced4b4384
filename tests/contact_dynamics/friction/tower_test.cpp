// Packings that stand by friction, and the restart of a state that turns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <string>

#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

// What stands moves only by rounding errors of positions of about 10, and by residuals, which are
// tolerated up to 5e-7 mean radii in a step but are near rounding errors where nothing changes.
constexpr double kRounding = 1e-9;

/// Rows of discs in the triangular lattice on y = 0, `width` in the lowest one and one less in each
/// further row, so that each disc lies on two.
State tower(int width, int rows) {
  State state = no_particles(2);
  const double height = std::sqrt(3.0) / 2;
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < width - row; ++k)
      add_particle(state, {k + 0.5 * row, 0.5 + row * height, 0}, 0.5, 1);
  add_rotation(state.particles);
  return state;
}

Setting with_gravity(double friction) {
  Setting setting;
  setting.time_step = 0.01;
  setting.laws.film.gamma_min = 0;
  if (friction > 0) setting.laws.friction = FrictionLaw{friction};
  setting.gravity = {0, -1, 0};
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  return setting;
}

double farthest_moved(const State& now, const State& start) {
  double farthest = 0;
  for (std::size_t k = 0; k < now.particles.count(); ++k)
    farthest = std::max(farthest, norm(now.particles.position(k) - start.particles.position(k)));
  return farthest;
}

TEST(Tower, ThreeDiscsStandFromAnAngleOfFrictionOf15DegreesOn) {
  // A disc of the lower row touches the floor and the disc above it. Both forces pass through both
  // contacts, 15 degrees from the normals: mu_s >= tan(15 degrees) = 2 - sqrt(3).
  const double least = 2 - std::sqrt(3.0);
  const auto start = tower(2, 2);
  for (const double factor : {1 - 1e-3, 1 + 1e-3}) {
    Simulation simulation(with_gravity(factor * least), start, 1);
    run(simulation, 1, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    const double moved = farthest_moved(simulation.state(), start);
    if (factor > 1)
      EXPECT_LT(moved, kRounding);
    else
      EXPECT_GT(moved, 1e-5);
  }
}

TEST(Tower, StandsByFrictionAndFlattensWithoutIt) {
  const auto start = tower(10, 4);
  Simulation rough(with_gravity(1), start, 1);  // 1e4 steps
  run(rough, 100, [](const StepReport& report) { ASSERT_TRUE(report.converged) << report.time; });
  EXPECT_LT(farthest_moved(rough.state(), start), kRounding);
  Simulation smooth(with_gravity(0), start, 1);
  run(smooth, 2);
  EXPECT_GT(farthest_moved(smooth.state(), start), 0.1);
}

TEST(Tower, ARestartContinuesBitForBit) {
  for (const int dimension : {2, 3}) {
    auto state = no_particles(dimension);
    for (int k = 0; k < 4; ++k) add_particle(state, {0.1 * k, 0.6 + 1.05 * k, 0.05 * k}, 0.5, 1);
    add_rotation(state.particles);
    for (auto& w : state.particles.angular_velocities) w = 1.5;
    const auto setting = with_gravity(0.3);
    Simulation whole(setting, state, 1);
    run(whole, 1);
    const std::string path = ::testing::TempDir() + "/tower_restart.bin";
    std::ofstream(path, std::ios::binary) << write_restart(whole.state());
    Simulation continued(setting, read_restart(path), 2);
    run(whole, 2);
    run(continued, 2);
    EXPECT_EQ(whole.state().particles.positions, continued.state().particles.positions);
    EXPECT_EQ(whole.state().particles.angles, continued.state().particles.angles);
    EXPECT_EQ(whole.state().particles.orientations, continued.state().particles.orientations);
    EXPECT_EQ(whole.state().particles.angular_velocities,
              continued.state().particles.angular_velocities);
    EXPECT_EQ(whole.state().pairs, continued.state().pairs);
  }
}

}  // namespace
}  // namespace viscontact::particles
