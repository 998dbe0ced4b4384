// The leapfrog reading of the scheme, docs/physics.md (5.10): positions of second order away from
// impacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/rotation.hpp"

namespace viscontact::particles {
namespace {

/// m = r = 1, gap 1 to the plane below, a force of 1 at 45 degrees down, reversed at t = 5; the film
/// is smooth. It absorbs 5 sqrt(1/2) and gives it back until t = 10.
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

TEST(Leapfrog, ReportsVelocitiesAtThePresentTime) {
  auto simulation = release(0.01, Scheme::kLeapfrog);
  run(simulation, 12);
  EXPECT_NEAR(simulation.reported_particles().velocity(0)[1], std::numbers::sqrt2, 1e-9);
  // Half a step earlier.
  EXPECT_NEAR(simulation.state().particles.velocity(0)[1],
              std::numbers::sqrt2 - 0.005 * std::sqrt(0.5), 1e-9);
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
