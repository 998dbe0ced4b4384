// Hinges, springs and arms against closed forms.
#include "viscontact/particles/links/links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/common/error.hpp"

namespace viscontact::particles {
namespace {

constexpr double kPi = std::numbers::pi;

Setting setting_of(double h, Scheme scheme = Scheme::kLeapfrog) {
  Setting setting;
  setting.time_step = h;
  setting.scheme = scheme;
  setting.solver.tolerance = 1e-10;
  return setting;
}

State two_particles(int dimension, double apart, const Vector& velocity = {}) {
  State state = no_particles(dimension);
  add_particle(state, {}, 0.1, 2);
  add_particle(state, {apart, 0, 0}, 0.1, 3, velocity);
  add_rotation(state.particles);
  return state;
}

double distance(const State& state) {
  return norm(state.particles.position(1) - state.particles.position(0));
}

TEST(Springs, TwoMassesSwingWithTheirPeriodAndOfSecondOrder) {
  const double k = 5, amplitude = 0.3, w = std::sqrt(k / (2.0 * 3.0 / 5.0));
  std::vector<double> errors;
  for (const double h : {0.04, 0.02, 0.01}) {
    auto setting = setting_of(h);
    setting.links.springs = {{0, 1, k, 2.0}};
    Simulation simulation(setting, two_particles(2, 2 + amplitude), 1);
    run(simulation, 4, expect_converged);
    errors.push_back(distance(simulation.state()) - 2 - amplitude * std::cos(4 * w));
  }
  EXPECT_LT(std::abs(errors[2]), 1e-3);
  EXPECT_NEAR(std::log2(std::abs(errors[0] / errors[1])), 2, 0.3);
  EXPECT_NEAR(std::log2(std::abs(errors[1] / errors[2])), 2, 0.3);
}

TEST(Springs, AStiffSpringStaysStableAndIsNotDamped) {
  // h w = 100: an explicit method would fail at 2.
  const double h = 0.01, k = 1.2e8;
  auto setting = setting_of(h);
  setting.links.springs = {{0, 1, k, 2.0}};
  Simulation simulation(setting, two_particles(3, 2 + 1e-6), 1);
  double largest = 0;
  run(simulation, 10, [&](const StepReport& report) {
    expect_converged(report);
    if (report.time > 5) largest = std::max(largest, std::abs(distance(simulation.state()) - 2));
  });
  EXPECT_LT(largest, 1.01e-6);
  EXPECT_GT(largest, 0.9e-6);
}

TEST(Springs, ThatTurnGainNoEnergyHoweverStiffTheyAre) {
  for (const auto scheme : {Scheme::kLeapfrog, Scheme::kEuler})
    for (const double k : {1e2, 1e3, 1e4, 1e5, 1e6})
      for (const double h : {0.02, 0.1, 0.2, 0.4}) {
        auto setting = setting_of(h, scheme);
        setting.links.springs = {{0, 1, k, 1.0}};
        State state = no_particles(2);
        add_particle(state, {-0.5, 0, 0}, 0.1, 1, {0, -0.5, 0});
        add_particle(state, {0.5, 0, 0}, 0.1, 1, {0, 0.5, 0});
        add_rotation(state.particles);
        Simulation simulation(setting, state, 1);
        const auto& p = simulation.state().particles;
        for (int n = 0; n < 400; ++n) {
          simulation.step(1e9);
          EXPECT_LE(kinetic_energy(p), 0.25 * (1 + 1e-9)) << k << " " << h << " " << n;
          if (HasFailure()) return;
        }
        // The scheme is of second order in the turn of a step, h.
        EXPECT_NEAR(kinetic_energy(p), 0.25, 0.25 * h * h + 0.01) << k << " " << h;
        EXPECT_NEAR(norm(angular_momentum(p)), 0.5, 1e-9) << k << " " << h;
      }
}

TEST(Springs, OfAllStiffnessesHaveTheirForceInStepsOfAllLengthsBesideABody) {
  for (double h = 1e-9; h < 2; h *= std::sqrt(1000))
    for (double k = 1e-12; k < 2e12; k *= 100) {
      auto setting = setting_of(h, Scheme::kEuler);
      setting.links.springs = {{1, 2, k, 3}};
      State state = no_particles(2);
      for (const double x : {0.0, 2.0, 6.0}) add_particle(state, {x, 0, 0}, 0.1, 2);
      add_rotation(state.particles);
      add_rigid_body(state.particles, {{0, 1}});
      Simulation simulation(setting, state, 1);
      expect_converged(simulation.step(h));
      // (5.13) at rest with the extension 1 and the mobility 1/4 + 1/2: in the first step, the
      // extension at its end counts.
      const double force = -k / (1 + h * h * k * 0.75);
      // The tolerance of the solver of 1e-10 mean radii is one of 1e-11 of the extension.
      EXPECT_NEAR(simulation.state().link_forces[0], force, -1e-9 * force) << h << " " << k;
    }
}

class Hinges : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Hinges, ::testing::Values(2, 3));

/// A body of two particles whose centre of mass is at a distance 1 from a hinge at the origin.
State pendulum(int dimension, double angle) {
  State state = no_particles(dimension);
  for (const double at : {0.8, 1.2})
    add_particle(state, {at * std::sin(angle), -at * std::cos(angle), 0}, 0.3, 1);
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{0, 1}});
  return state;
}

TEST_P(Hinges, APendulumSwingsWithItsPeriodAndOfSecondOrder) {
  const int dimension = GetParam();
  const double inertia = 2 * round_shape(dimension, 0.3).inertia(1) + 0.8 * 0.8 + 1.2 * 1.2;
  const double g = 9.81, w = std::sqrt(2 * g / inertia), amplitude = 1e-3;
  std::vector<double> errors;
  for (const double h : {0.04, 0.02, 0.01}) {
    auto setting = setting_of(h);
    setting.gravity = {0, -g, 0};
    auto state = pendulum(dimension, amplitude);
    Hinge hinge;
    hinge.point = {0, -1 * state.particles.bodies.bodies[0].centre};
    setting.links.hinges = {hinge};
    Simulation simulation(setting, state, 1);
    run(simulation, 3, expect_converged);
    const auto& body = simulation.state().particles.bodies.bodies[0];
    EXPECT_NEAR(norm(body.centre), 1, 1e-10);
    errors.push_back(body.centre[0] / amplitude - std::cos(3 * w));
    // The hinge carries the weight, up to squares of the amplitude.
    EXPECT_NEAR(simulation.state().link_forces[1], 2 * g, 1e-4);
  }
  EXPECT_LT(std::abs(errors[2]), 1e-2);
  EXPECT_NEAR(std::log2(std::abs(errors[0] / errors[1])), 2, 0.3);
  EXPECT_NEAR(std::log2(std::abs(errors[1] / errors[2])), 2, 0.3);
}

TEST_P(Hinges, ALargeSwingKeepsThePointAndTheEnergy) {
  const int dimension = GetParam();
  auto setting = setting_of(0.01);
  setting.gravity = {0, -9.81, 0};
  auto state = pendulum(dimension, 2.5);
  Hinge hinge;
  hinge.point = {0, -1 * state.particles.bodies.bodies[0].centre};
  setting.links.hinges = {hinge};
  Simulation simulation(setting, state, 1);
  double highest = -1;
  run(simulation, 10, [&](const StepReport& report) {
    expect_converged(report);
    const auto& body = simulation.state().particles.bodies.bodies[0];
    EXPECT_NEAR(norm(body.centre), 1, 1e-9);
    if (report.time > 5) highest = std::max(highest, body.centre[1]);
  });
  // It swings back to where it began, -cos(2.5) = 0.8011; the method neither gains nor loses much.
  EXPECT_NEAR(highest, -std::cos(2.5), 5e-3);
}

TEST(Hinges, APlaneThatASwingingDiscPassesAtASmallDistanceChangesNothing) {
  // The disc swings about the origin from one side of its lowest point to the other. Equations
  // about the beginning of a step see the tangent of its circle, which the plane cuts before the
  // lowest point.
  constexpr double kRadius = 0.5;
  for (const double clearance : {1e-6, 1e-3, 0.05})
    for (const bool has_friction : {false, true})
      for (const double h : {0.01, 0.017, 0.1}) {
        SCOPED_TRACE(testing::Message() << "clearance " << clearance << ", step " << h
                                        << ", friction " << has_friction);
        const auto swing = [&](bool has_plane) {
          auto setting = setting_of(h, Scheme::kEuler);
          if (has_friction) setting.laws.friction = FrictionLaw{0.3};
          State state = no_particles(2);
          const double angle = -0.5, rate = 1;
          const Vector place{std::sin(angle), -std::cos(angle), 0};
          add_particle(state, place, kRadius, 1, rate * Vector{-place[1], place[0], 0});
          add_rotation(state.particles);
          state.particles.angular_velocities[0] = rate;
          Hinge hinge;
          hinge.point = {0, -1 * place};
          setting.links.hinges = {hinge};
          if (has_plane)
            setting.planes = {plane_at_rest({0, -1 - kRadius - clearance, 0}, {0, 1, 0})};
          Simulation simulation(setting, state, 1);
          run(simulation, 1, expect_converged);
          return simulation.state().particles;
        };
        const auto with = swing(true), without = swing(false);
        EXPECT_GT(with.angular_velocities[0], 0.9);
        EXPECT_NEAR(with.angular_velocities[0], without.angular_velocities[0], 1e-8);
        EXPECT_NEAR(norm(with.position(0) - without.position(0)), 0, 1e-8);
      }
}

TEST(Hinges, ADiscThatLeavesThePlaneStopsWhereItMeetsThePlaneAgain) {
  // The hinge is 0.006 beside the contact. A force turns the disc about it, so that the disc rises,
  // and meets the plane again after twice the angle atan(0.006/0.8).
  auto setting = setting_of(0.01, Scheme::kEuler);
  setting.planes = {plane_at_rest({0, -1, 0}, {0, 1, 0})};
  setting.forces[0] = constant({-100, 0, 0});
  State state = no_particles(2);
  add_particle(state, {}, 1, 1.6);
  add_rotation(state.particles);
  Hinge hinge;
  hinge.at = {-0.006, -0.8, 0};
  hinge.point = {0, hinge.at};
  setting.links.hinges = {hinge};
  Simulation simulation(setting, state, 1);
  run(simulation, 0.1, expect_converged);
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.angles[0], 2 * std::atan(0.006 / 0.8), 1e-6);
  EXPECT_NEAR(p.angular_velocities[0], 0, 1e-6);
}

TEST(Arms, ADiscSwingsAroundAnotherThatAHingeHoldsAtTheOrigin) {
  // Nothing but the arm acts on the particles, and the coordinates of the first are 0.
  auto setting = setting_of(0.01, Scheme::kEuler);
  State state = no_particles(2);
  add_particle(state, {}, 1, 1);
  add_particle(state, {3, 0, 0}, 1, 1, {0, 3, 0});
  add_rotation(state.particles);
  setting.links.hinges = {Hinge{}};
  setting.links.arms = {{0, 1, SinusoidalLength{3, 0, 0, 0}}};
  Simulation simulation(setting, state, 1);
  run(simulation, 1, [&](const StepReport& report) {
    expect_converged(report);
    EXPECT_NEAR(distance(simulation.state()), 3, 1e-9);
  });
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(norm(p.velocity(1)), 3, 1e-3);
  // The angle is 1 up to the square of the turn in a step, 0.01.
  EXPECT_NEAR(std::atan2(p.position(1)[1], p.position(1)[0]), 1, 1e-3);
}

TEST(TorsionSprings, ADiscOnAHingeTurnsAsAnOscillator) {
  auto setting = setting_of(0.01);
  State state = no_particles(2);
  add_particle(state, {1, 2, 0}, 0.5, 4);
  add_rotation(state.particles);
  Hinge hinge;
  hinge.at = {1, 2, 0};
  hinge.stiffness = 3;
  hinge.rest_angle = 0.5;
  setting.links.hinges = {hinge};
  Simulation simulation(setting, state, 1);
  run(simulation, 2, expect_converged);
  const double w = std::sqrt(3 / round_shape(2, 0.5).inertia(4));
  EXPECT_NEAR(simulation.state().particles.angles[0], 0.5 - 0.5 * std::cos(2 * w), 2e-3);
  EXPECT_NEAR(norm(simulation.state().particles.position(0) - Vector{1, 2, 0}), 0, 1e-14);
  // The torque of the spring is that of its extension.
  EXPECT_NEAR(simulation.state().link_forces[2],
              -3 * (simulation.state().particles.angles[0] - 0.5), 0.1);
}

TEST(Arms, APrescribedLengthIsKeptAndItsForceIsTheReducedMassTimesTheAcceleration) {
  for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
    for (const int dimension : {2, 3}) {
      auto setting = setting_of(0.01, scheme);
      const SinusoidalLength length{2, 0.5, 3, 0.2};
      setting.links.arms = {{0, 1, length}};
      auto state = two_particles(dimension, length_at(length, 0));
      // The velocities of the start are those of the arm.
      const double rate = 0.5 * 3 * std::cos(0.2);
      state.particles.velocities[0] = -rate * 3 / 5;
      state.particles.velocities[static_cast<std::size_t>(dimension)] = rate * 2 / 5;
      Simulation simulation(setting, state, 1);
      run(simulation, 2, [&](const StepReport& report) {
        expect_converged(report);
        EXPECT_NEAR(distance(simulation.state()), length_at(length, report.time), 1e-10);
      });
      // The force of a step is that at its beginning.
      const double acceleration = -0.5 * 9 * std::sin(3 * 1.99 + 0.2);
      EXPECT_NEAR(simulation.state().link_forces[0], 2.0 * 3 / 5 * acceleration, 1e-3);
      EXPECT_NEAR(norm(momentum(simulation.state().particles)), 0, 1e-9);
    }
}

TEST(Arms, ARotatingArmThatShortensTurnsFasterByItsAngularMomentum) {
  auto setting = setting_of(1e-3);
  setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 2}, {1, 2}, {3, 1}}}}};
  auto state = two_particles(2, 2, {0, 1, 0});
  Simulation simulation(setting, state, 1);
  run(simulation, 4, expect_converged);
  const auto& p = simulation.state().particles;
  const Vector apart = p.position(1) - p.position(0), v = p.velocity(1) - p.velocity(0);
  // r x v is constant: 2 at the start.
  EXPECT_NEAR(apart[0] * v[1] - apart[1] * v[0], 2, 1e-2);
  EXPECT_NEAR(norm(apart), 1, 1e-10);
}

TEST(Arms, TheirPowerAddsUpToTheEnergyThatTheyGive) {
  // The length has a kink at the start, and two more; the pair turns, and one end is a member of a
  // body that turns about its centre.
  for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
    for (const bool is_body : {false, true}) {
      const double h = 0.01;
      auto setting = setting_of(h, scheme);
      setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 2}, {0.5, 1.5}, {1, 3}}}}};
      auto state = two_particles(2, 2, {0, 1, 0});
      if (is_body) {
        state = no_particles(2);
        add_particle(state, {}, 0.1, 2);
        add_particle(state, {2, 0, 0}, 0.1, 3);
        add_particle(state, {3, 1, 0}, 0.1, 1);
        add_rotation(state.particles);
        add_rigid_body(state.particles, {{1, 2}});
      }
      const auto energy = [&](const State& of) {
        const auto& p = of.particles;
        if (!is_body) return kinetic_energy(p);
        const auto& body = p.bodies.bodies[0];
        return p.masses[0] / 2 * dot(p.velocity(0), p.velocity(0)) +
               body.mass / 2 * dot(body.velocity, body.velocity) +
               body.inertia[8] / 2 * body.angular_velocity[2] * body.angular_velocity[2];
      };
      Simulation simulation(setting, state, 1);
      const double before = energy(simulation.state());
      double work = 0, largest = 0, time = 0;
      run(simulation, 1.5, [&](const StepReport& report) {
        expect_converged(report);
        work += power_of_arm(setting, simulation.state()) * (report.time - time);
        time = report.time;
        largest = std::max(largest, energy(simulation.state()));
        // The tolerance of the gaps, 1e-10, over h is one of the velocities.
        EXPECT_NEAR(energy(simulation.state()) - before, work, 1e-7) << report.time;
      });
      EXPECT_GT(largest - before, 5);
    }
}

TEST(Arms, ParticlesThatAnArmHoldsInTouchTurnAsOneWhateverTheirContactWouldBe) {
  // The contact would contradict the arm to second order in its turn of 0.1 in a step. The friction
  // of a contact is not a part of the motion: the load of the contact beside an arm is not unique.
  for (const int dimension : {2, 3})
    for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex}) {
      auto setting = setting_of(0.01);
      setting.laws.film.gamma_min = -0.3;
      setting.laws.friction = FrictionLaw{0.7, method};
      setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 0.2}}}}};
      Simulation simulation(setting, two_particles(dimension, 0.2, {0, 2, 0}), 1);
      const auto moment = norm(angular_momentum(simulation.state().particles));
      run(simulation, 2, [&](const StepReport& report) {
        expect_converged(report);
        EXPECT_NEAR(distance(simulation.state()), 0.2, 1e-10) << report.time;
        EXPECT_EQ(report.contacts, 0);
      });
      const auto& p = simulation.state().particles;
      // The rate 2/0.2 of the turn; the scheme is of second order in the turn of a step.
      EXPECT_NEAR(norm(p.velocity(1) - p.velocity(0)), 2, 2e-2);
      EXPECT_NEAR(norm(angular_momentum(p)), moment, 1e-2 * moment);
      for (const double w : p.angular_velocities) EXPECT_EQ(w, 0);
    }
}

TEST(Arms, ADiscWithoutRoomBetweenTwoThatAnArmHoldsTurnsWithThem) {
  // The arm turns with the rate W = w - p/2, where p is the impulse of friction on each end.
  // Friction sets off the ends with p/I and the disc between them with 2 p/I, for masses and radii
  // of 1, until surfaces rest, 3 p/I = 2 W. When contacts were linear along the normals at the
  // beginning of a step, they contradicted the arm, and the energy grew from 4 to 4661.
  constexpr double kInertia = 0.5;
  for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex})
    for (const double w : {0.01, 1.0})
      for (const double mu_s : {0.0, 0.5}) {
        SCOPED_TRACE(w);
        SCOPED_TRACE(mu_s);
        auto setting = setting_of(0.01, Scheme::kEuler);
        setting.solver.tolerance = 1e-6;
        setting.laws.film.gamma_min = 0;
        if (mu_s > 0) setting.laws.friction = FrictionLaw{mu_s, method};
        setting.links.arms = {{0, 2, PiecewiseLinearLength{{{0, 4}}}}};
        State state = no_particles(2);
        for (const double x : {-2, 0, 2}) add_particle(state, {x, 0, 0}, 1, 1, {0, w * x, 0});
        add_rotation(state.particles);
        Simulation simulation(setting, state, 1);
        run(simulation, 2, expect_converged);
        const auto& p = simulation.state().particles;
        // The load of a disc without room is not unique. With a small one the surfaces slip.
        const double most = mu_s > 0 ? 2 * w / (1 + 3 / kInertia) : 0;
        const double impulse = kInertia * p.angular_velocities[0];
        // The scheme is of second order in the turn of a step, at most 0.01.
        const double error = 2e-4 * w;
        EXPECT_LE(impulse, most + error);
        EXPECT_GE(impulse, -error);
        EXPECT_NEAR(norm(p.velocity(2) - p.velocity(0)) / 4, w - impulse / 2, error);
        EXPECT_NEAR(p.angular_velocities[1], 2 * impulse / kInertia, error);
        EXPECT_NEAR(p.angular_velocities[2], impulse / kInertia, error);
        for (const std::size_t k : {0, 2})
          EXPECT_NEAR(norm(p.position(k) - p.position(1)), 2, 1e-6);
      }
}

TEST(Arms, AroundADiscTurnWithItAlsoFarFromTheOrigin) {
  // Gaps and lengths are differences of coordinates, whose rounding errors are 1e-12 of the radius
  // here. A third of these steps did not converge when errors were those of the radii.
  for (const double gamma_min : {-0.3, 0.0})
    for (const double h : {0.001, 0.1}) {
      SCOPED_TRACE(h);
      auto setting = setting_of(h, Scheme::kEuler);
      setting.solver.tolerance = 1e-6;
      setting.laws.film.gamma_min = gamma_min;
      setting.laws.friction = FrictionLaw{0.5, FrictionMethod::kConvex};
      State state = no_particles(2);
      const Vector centre{1e4, 7e3, 0};
      add_particle(state, centre, 1, 1);
      for (const double angle : {0.0, 2.0, 4.0}) {
        const Vector apart{2 * std::cos(angle), 2 * std::sin(angle), 0};
        add_particle(state, centre + apart, 1, 1, {-apart[1], apart[0], 0});
      }
      add_rotation(state.particles);
      for (std::int32_t k = 1; k < 4; ++k) {
        const std::int32_t next = k % 3 + 1;
        const double length =
            norm(state.particles.position(index_of(next)) - state.particles.position(index_of(k)));
        setting.links.arms.push_back({k, next, PiecewiseLinearLength{{{0, length}}}});
      }
      Simulation simulation(setting, state, 1);
      run(simulation, 20 * h, expect_converged);
    }
}

TEST(Arms, HoldOneImageOfAParticleWhileAnotherOneMayTouch) {
  // The cell has the length 3.9 along x. The pair turns towards the x axis until the image on the
  // other side touches, too. A case may give the length 2 with a rounding error of 1e-6 of it.
  for (const double length : {2.0, 2 * (1 - 5e-7)}) {
    auto setting = setting_of(0.01, Scheme::kEuler);
    setting.domain = BoxDomain{{0, 0}, {3.9, 20}, {true, false}};
    setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, length}}}}};
    State state = no_particles(2);
    state.particles.cell = cell_of(setting);
    const Vector along{std::cos(1.2), std::sin(1.2), 0}, turns{-0.5 * along[1], 0.5 * along[0], 0};
    add_particle(state, {0.5, 8, 0}, 1, 1, turns);
    add_particle(state, Vector{0.5, 8, 0} + length * along, 1, 1, -1 * turns);
    add_rotation(state.particles);
    Simulation simulation(setting, state, 1);
    bool touched = false;
    run(simulation, 3, [&](const StepReport& report) {
      expect_converged(report);
      touched |= report.contacts > 0;
      const auto& p = simulation.state().particles;
      const Vector apart = p.position(1) - p.position(0);
      for (const double shift : {-3.9, 0.0, 3.9})
        EXPECT_GE(norm(apart + Vector{shift, 0, 0}), 2 * (1 - 1e-6)) << report.time;
    });
    EXPECT_TRUE(touched);
  }
}

TEST(Arms, ThreeArmsThatBreakTheTriangleInequalityAreNamed) {
  auto setting = setting_of(0.01);
  setting.solver.tolerance = 1e-6;
  State state = no_particles(2);
  add_particle(state, {0, 0, 0}, 0.1, 1);
  add_particle(state, {1, 0, 0}, 0.1, 1);
  add_particle(state, {0.5, 0.5, 0}, 0.1, 1);
  add_rotation(state.particles);
  const double side = std::sqrt(0.5);
  setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 1}, {1, 3}}}},
                        {1, 2, PiecewiseLinearLength{{{0, side}}}},
                        {2, 0, PiecewiseLinearLength{{{0, side}}}}};
  Simulation simulation(setting, state, 1);
  try {
    run(simulation, 1);
    FAIL() << "the arms cannot meet after 2 side = 1.414, at t = 0.207";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kNotConverged);
    for (const auto* name :
         {"arm 0 (particles 0 and 1)", "arm 1 (particles 1 and 2)", "arm 2 (particles 2 and 0)"})
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    EXPECT_NEAR(simulation.state().time, 0.207, 0.02);
  }
}

TEST(Links, OnlyThoseThatContradictEachOtherAreNamed) {
  // The arm between two pinned particles gets longer. Arms that hold the same particles or the next
  // ones, and a particle that lies on a plane, could follow.
  for (const bool is_reversed : {false, true}) {
    auto setting = setting_of(0.01);
    setting.solver.tolerance = 1e-6;
    setting.gravity = {0, -1, 0};
    State state = no_particles(2);
    for (int k = 0; k < 5; ++k) add_particle(state, {1.0 * k, 0.1, 0}, 0.1, 1);
    add_rotation(state.particles);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.links.arms = {{0, 1, PiecewiseLinearLength{{{0, 1}, {1, 3}}}},
                          {1, 2, PiecewiseLinearLength{{{0, 1}}}},
                          {2, 3, PiecewiseLinearLength{{{0, 1}}}}};
    if (is_reversed) std::ranges::reverse(setting.links.arms);
    for (const std::int32_t k : {0, 1})
      setting.links.hinges.push_back({{k, {}}, {1.0 * k, 0.1, 0}, 0, 0, -1});
    Simulation simulation(setting, state, 1);
    try {
      run(simulation, 1);
      FAIL();
    } catch (const Error& error) {
      const std::string said = error.what();
      EXPECT_EQ(error.kind(), ErrorKind::kNotConverged);
      const std::string guilty =
          is_reversed ? "arm 2 (particles 0 and 1)" : "arm 0 (particles 0 and 1)";
      for (const auto& name :
           {guilty, std::string("hinge 0 (particle 0)"), std::string("hinge 1 (particle 1)")})
        EXPECT_NE(said.find(name), std::string::npos) << said;
      for (const auto* name : {"arm 1", "(particles 1 and 2)", "(particles 2 and 3)", "overlap"})
        EXPECT_EQ(said.find(name), std::string::npos) << said;
    }
  }
}

TEST(Links, AChainOfHingedBodiesHangsAtRest) {
  // Redundant links do no harm: two bodies, each held by two hinges at its ends.
  auto setting = setting_of(0.01, Scheme::kEuler);
  setting.gravity = {0, -9.81, 0};
  State state = no_particles(2);
  for (int k = 0; k < 4; ++k) add_particle(state, {0.5 * k, 0, 0}, 0.3, 1);
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{0, 1, 2, 3}});
  for (const double x : {0.0, 1.5}) {
    Hinge hinge;
    hinge.at = {x, 0, 0};
    hinge.point = {0, {x - 0.75, 0, 0}};
    setting.links.hinges.push_back(hinge);
  }
  Simulation simulation(setting, state, 1);
  run(simulation, 1, expect_converged);
  EXPECT_NEAR(simulation.state().particles.position(0)[1], 0, 1e-12);
  EXPECT_NEAR(simulation.state().link_forces[1] + simulation.state().link_forces[4], 4 * 9.81,
              1e-6);
}

}  // namespace
}  // namespace viscontact::particles
