// Particles that go further than their size in a step.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::particles {
namespace {

Setting of_step(double h) {
  Setting setting;
  setting.time_step = h;
  return setting;
}

TEST(FastParticles, ThatPassClearAreNotTouched) {
  // Half a radius clear, at 5 radii a step; and closer and faster.
  for (const int dimension : {2, 3})
    for (const auto& [speed, clear] :
         {std::pair(5.0, 0.5), std::pair(50.0, 0.1), std::pair(1e4, 0.5)})
      for (const double from : {-20.0, -3.7, -1.0}) {
        SCOPED_TRACE(testing::Message() << dimension << ' ' << speed << ' ' << from);
        State state = no_particles(dimension);
        add_particle(state, {from, 2 + clear, 0}, 1, 1, {speed, 0, 0});
        add_particle(state, {0, 0, 0}, 1, 1);
        Simulation simulation(of_step(1), state, 1);
        for (int n = 0; n < 5; ++n) EXPECT_EQ(simulation.step(1e9).unresolved, 0U);
        EXPECT_EQ(norm(simulation.state().particles.velocity(1)), 0);
        EXPECT_EQ(simulation.state().particles.velocity(0)[0], speed);
      }
}

TEST(FastParticles, ThatHitOneAreNotStoppedByThoseBehindIt) {
  State state = no_particles(2);
  add_particle(state, {-6, 0, 0}, 1, 1, {5, 0, 0});
  add_particle(state, {0, 0, 0}, 1, 1);
  add_particle(state, {4, 2.5, 0}, 1, 1);
  Simulation simulation(of_step(1), state, 1);
  for (int n = 0; n < 2; ++n) simulation.step(1e9);
  EXPECT_EQ(norm(simulation.state().particles.velocity(2)), 0);
  EXPECT_NEAR(simulation.state().particles.velocity(1)[0], 2.5, 1e-9);
}

TEST(FastParticles, HitAsSlowerOnesDo) {
  // Off the centre, at 5 radii a step: the pair keeps together and turns, so that where it is after
  // a time depends on where they met. The step is divided; undivided, it would take a tenth of it.
  const auto after = [](double h) {
    State state = no_particles(2);
    add_particle(state, {-7, 1.2, 0}, 1, 1, {5, 0, 0});
    add_particle(state, {0, 0, 0}, 1, 1);
    Simulation simulation(of_step(h), state, 1);
    int parts = 0;
    run(simulation, 2, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged);
      EXPECT_EQ(report.unresolved, 0U);
      parts = std::max(parts, report.parts);
    });
    EXPECT_EQ(parts > 1, h == 1);
    const auto& p = simulation.state().particles;
    EXPECT_NEAR(momentum(p)[0], 5, 1e-9);
    EXPECT_NEAR(momentum(p)[1], 0, 1e-9);
    return p.position(1);
  };
  const auto coarse = after(1), fine = after(1.0 / 1024);
  // Parts are as long as half of the radii's sum, 1; seen: 0.5.
  EXPECT_LE(norm(coarse - fine), 1);
}

TEST(FastParticles, DivisionLeavesTheTimesOfTheGrid) {
  State state = no_particles(2);
  add_particle(state, {-7, 1.2, 0}, 1, 1, {5, 0, 0});
  add_particle(state, {0, 0, 0}, 1, 1);
  Simulation simulation(of_step(0.1), state, 1);
  int n = 0;
  run(simulation, 3, [&](const StepReport& report) { EXPECT_DOUBLE_EQ(report.time, 0.1 * ++n); });
  EXPECT_EQ(n, 30);
  EXPECT_EQ(simulation.state().steps, 30);
}

TEST(FastParticles, BeyondTheLargestDivisionAreCounted) {
  State state = no_particles(2);
  add_particle(state, {-7, 1.2, 0}, 1, 1, {1e5, 0, 0});
  add_particle(state, {0, 0, 0}, 1, 1e-3);
  Simulation simulation(of_step(1), state, 1);
  std::size_t unresolved = 0;
  for (int n = 0; n < 2; ++n) unresolved += simulation.step(1e9).unresolved;
  EXPECT_GT(unresolved, 0U);
}

TEST(FastParticles, WithoutTimeForAStepHaveNoParts) {
  State state = no_particles(2);
  add_particle(state, {0, 0, 0}, 1, 1, {1e5, 0, 0});
  Simulation simulation(of_step(1), state, 1);
  EXPECT_EQ(simulation.step(0).parts, 0);
  EXPECT_EQ(simulation.step(1).parts, 1);
}

TEST(ClosingWalls, EndTheRunOnceTheOverlapPassesARadius) {
  Random random(3);
  auto state = random_cloud(
      2, 300, 60, [] { return 1.0; }, random);
  Setting setting = of_step(0.05);
  for (const double side : {-1.0, 1.0}) {
    auto plane = plane_at_rest({side * 40, 0, 0}, {-side, 0, 0});
    plane.velocity = {{{1e9, {-side * 10, 0, 0}}}};
    setting.planes.push_back(plane);
    setting.planes.push_back(plane_at_rest({0, side * 40, 0}, {0, -side, 0}));
  }
  setting.solver.max_iterations = 2000;
  Simulation simulation(setting, state, 1);
  try {
    for (int n = 0; n < 80; ++n) simulation.step(1e9);
    FAIL() << "the walls have met";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kNotConverged);
    const std::string message = error.what();
    EXPECT_NE(message.find("do planes -1, -3 leave"), std::string::npos) << message;
    EXPECT_NE(message.find("overlap"), std::string::npos) << message;
  }
  // What was computed before is kept.
  EXPECT_GT(simulation.state().time, 0.5);
  for (const double x : simulation.state().particles.positions) EXPECT_LE(std::abs(x), 42);
}

}  // namespace
}  // namespace viscontact::particles
