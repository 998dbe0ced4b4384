// The leapfrog reading of the scheme, docs/physics.md (5.10): positions of second order away from
// impacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

/// m = r = 1, gap 1 to the plane below, a force of 1 at 45 degrees down, reversed at t = 5; the
/// film is smooth. It absorbs 5 sqrt(1/2) and gives it back until t = 10.
Simulation release(double h, Scheme scheme) {
  State state = no_particles(2);
  add_particle(state, {0, 2, 0}, 1, 1);
  Setting setting;
  setting.time_step = h;
  setting.scheme = scheme;
  const double push = std::sqrt(0.5);
  setting.forces[0] = {{{5, {push, -push, 0}}, {100, {-push, push, 0}}}};
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  return {setting, state, 1};
}

/// The gap at t = 10 if solid contact begins at gamma = -2.
double released_from_solid(double h, Scheme scheme) {
  auto before = release(h, scheme);
  auto setting = before.setting();
  setting.laws.film.gamma_min = -2;
  Simulation simulation(setting, before.state(), 1);
  run(simulation, 10);
  return simulation.state().particles.position(0)[1] - 1;
}

double gap_at_12(double h, Scheme scheme) {
  auto simulation = release(h, scheme);
  run(simulation, 12);
  return simulation.state().particles.position(0)[1] - 1;
}

TEST(Leapfrog, AfterAReleaseIsOfSecondOrder) {
  const double exact = std::sqrt(0.125) * 4;
  // The release falls somewhere in a step; its share theta makes an error of at most
  // sqrt(1/8) h^2/4.
  for (const double h : {0.1, 0.037, 0.01, 1e-3})
    EXPECT_NEAR(gap_at_12(h, Scheme::kLeapfrog), exact, 0.09 * h * h + 1e-9) << h;
  // Without it positions are ahead by h u/2, u = sqrt(2).
  EXPECT_NEAR(gap_at_12(0.01, Scheme::kEuler) - exact, 0.005 * std::numbers::sqrt2, 1e-4);
}

TEST(Leapfrog, AReleaseFromSolidContactIsOfSecondOrder) {
  // With gamma_min = -2 the film is given back 2 sqrt(2) after the force has changed sign at t = 5.
  const double pull = std::sqrt(0.5), left = 5 + 2 / pull;
  const double exact = pull / 2 * (10 - left) * (10 - left);
  EXPECT_NEAR(exact, 1.66726189, 1e-8);
  // As above, the share of the release in its step counts, here also that of the jump of the force,
  // which falls on the grid, or between two of its points.
  for (const double h : {0.1, 0.037, 0.0193, 0.01, 1e-3})
    EXPECT_NEAR(released_from_solid(h, Scheme::kLeapfrog), exact, 0.09 * h * h + 1e-9) << h;
  EXPECT_NEAR(released_from_solid(0.01, Scheme::kEuler) - exact, 7.7e-3, 1e-4);
}

TEST(Leapfrog, StepsAroundJumpsHaveTheJumpInTheirMiddleAndReturnToTheGrid) {
  const double h = 0.1;
  for (const double jump : {0.5, 0.51, 0.53, 0.549, 0.55, 0.56, 0.58, 0.599, 0.04, 0.001}) {
    SCOPED_TRACE(jump);
    double time = 0;
    bool is_in_middle = false;
    const std::vector<double> jumps = {jump};
    for (int n = 0; time < 1; ++n) {
      const double grid_end = h * (std::floor(time / h + 1e-6) + 1);
      const double end = leapfrog_step_end(time, grid_end, h, jumps);
      EXPECT_GT(end, time);
      EXPECT_LE(end - time, 1.001 * h);
      is_in_middle = is_in_middle || std::abs((time + end) / 2 - jump) < 1e-12;
      // No jump is between the middle of a step and its end, or of the next one and its beginning.
      if (std::abs((time + end) / 2 - jump) > 1e-12 && jump > 0.01) {
        EXPECT_FALSE(jump > time && jump < end) << time << " " << end;
      }
      time = end;
      ASSERT_LT(n, 20);
    }
    EXPECT_TRUE(is_in_middle);
    EXPECT_NEAR(time, 1, 1e-12);
  }
}

TEST(Leapfrog, ReportsVelocitiesAtThePresentTime) {
  auto simulation = release(0.01, Scheme::kLeapfrog);
  run(simulation, 12);
  EXPECT_NEAR(simulation.reported_particles().velocity(0)[1], std::numbers::sqrt2, 1e-9);
  // Half a step earlier.
  EXPECT_NEAR(simulation.state().particles.velocity(0)[1],
              std::numbers::sqrt2 - 0.005 * std::sqrt(0.5), 1e-9);
}

TEST(Leapfrog, FreeFallIsExactAlsoInStepsThatAFastDiscDivides) {
  // The first disc moves by two diameters in a step and hits the second.
  State state = no_particles(2);
  add_particle(state, {0, 0, 0}, 0.5, 1, {100, 0, 0});
  add_particle(state, {6, 0, 0}, 0.5, 1, {});
  Setting setting;
  setting.time_step = 0.02;
  setting.scheme = Scheme::kLeapfrog;
  setting.laws.film.gamma_min = 0;
  setting.gravity = {0, -1, 0};
  Simulation simulation(setting, state, 1);
  run(simulation, 0.4, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
  for (const std::size_t k : {0U, 1U})
    EXPECT_NEAR(simulation.state().particles.position(k)[1], -0.4 * 0.4 / 2, 1e-13) << k;
  EXPECT_NEAR(simulation.state().particles.velocity(1)[0], 50, 1e-8);
}

TEST(Leapfrog, FreeFlightIsExactAlsoWithCutSteps) {
  // x = g t^2/2, in steps of h and of what is left at each end. A step that is cut changes the
  // places at which velocities stand, which costs h^2 g/8 at most.
  State state = no_particles(3);
  add_particle(state, {}, 1, 1);
  add_rotation(state.particles);
  Setting setting;
  setting.time_step = 0.1;
  setting.scheme = Scheme::kLeapfrog;
  setting.gravity = {0, 0, -2};
  setting.torques[0] = constant({0, 0.4, 0});
  Simulation simulation(setting, state, 1);
  run(simulation, 1);
  EXPECT_NEAR(simulation.state().particles.position(0)[2], -1, 1e-14);
  EXPECT_NEAR(simulation.reported_particles().angular_velocities[1], 1, 1e-14);
  run(simulation, 1.537);
  EXPECT_NEAR(simulation.state().particles.position(0)[2], -1.537 * 1.537, 2 * 0.01 / 8);
}

}  // namespace
}  // namespace viscontact::particles
