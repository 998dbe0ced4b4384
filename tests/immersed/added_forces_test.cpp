// Forces and torques that the caller of a simulation sets between its steps: constant ones do what
// those of a case do, bit for bit, for particles, rigid bodies and particles in a fluid.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>

#include "tests/immersed/stand_in_fluid.hpp"
#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

const std::map<std::int32_t, Vector> kForces = {{0, {0.3, -0.7, 0.2}}, {2, {-1.1, 0.4, 0.9}}};
const Vector kTorque = {0.1, -0.2, 0.3};  // of discs component 2, on particle 1

/// Three particles above a plane on which they fall, with friction; two of them are a body if
/// `has_body`.
State falling(int dimension, bool has_body) {
  State state = no_particles(dimension);
  const auto at = [&](double x, double up) {
    return dimension == 2 ? Vector{x, up, 0} : Vector{x, 0.1 * x, up};
  };
  add_particle(state, at(0, 1.2), 1, 2, {0.5, 0, 0});
  add_particle(state, at(2.5, 1.1), 0.8, 1);
  add_particle(state, at(4.0, 2.0), 0.6, 3, {-0.5, 0, 0});
  add_rotation(state.particles);
  if (has_body) add_rigid_body(state.particles, {{1, 2}});
  return state;
}

Setting on_plane(int dimension, Scheme scheme) {
  Setting setting;
  const Vector up = dimension == 2 ? Vector{0, 1, 0} : Vector{0, 0, 1};
  setting.gravity = -1.0 * up;
  setting.planes = {plane_at_rest({0, 0, 0}, up)};
  setting.time_step = 0.02;
  setting.scheme = scheme;
  setting.laws.film.gamma_min = -0.1;
  setting.laws.friction = FrictionLaw{0.4};
  return setting;
}

/// Sets the forces above, and the torque if the particles turn.
template <class AnySimulation>
void set_added(AnySimulation& simulation) {
  const auto dimension = static_cast<std::size_t>(simulation.state().particles.dimension);
  const auto forces = simulation.added_forces();
  for (const auto& [particle, force] : kForces)
    for (std::size_t d = 0; d < dimension; ++d)
      forces[index_of(particle) * dimension + d] = force[d];
  const auto torques = simulation.added_torques();
  if (torques.empty()) return;
  for (std::size_t i = 0; i < (dimension == 3 ? 3 : 1); ++i)
    torques[(dimension == 3 ? 3 : 1) + i] = kTorque[dimension == 3 ? i : 2];
}

void set_in_case(Setting& setting) {
  for (const auto& [particle, force] : kForces) setting.forces[particle] = constant(force);
  setting.torques[1] = constant(kTorque);
}

void expect_same_bits(const Particles& one, const Particles& other) {
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.velocities, other.velocities);
  EXPECT_EQ(one.angular_velocities, other.angular_velocities);
  EXPECT_EQ(one.angles, other.angles);
  EXPECT_EQ(one.orientations, other.orientations);
}

TEST(AddedForces, ActAsConstantForcesOfTheCase) {
  for (const int dimension : {2, 3})
    for (const auto scheme : {Scheme::kEuler, Scheme::kLeapfrog})
      for (const bool has_body : {false, true}) {
        SCOPED_TRACE(testing::Message() << dimension << "D, body " << has_body << ", scheme "
                                        << static_cast<int>(scheme));
        const auto setting = on_plane(dimension, scheme);
        auto with_forces = setting;
        set_in_case(with_forces);
        Simulation of_case(with_forces, falling(dimension, has_body), 1);
        Simulation own(setting, falling(dimension, has_body), 2);
        Simulation free(setting, falling(dimension, has_body), 1);
        set_added(own);
        for (int step = 0; step < 150; ++step) {
          of_case.step(3);
          own.step(3);
          free.step(3);
        }
        expect_same_bits(own.state().particles, of_case.state().particles);
        expect_same_bits(own.reported_particles(), of_case.reported_particles());
        double moved = 0;
        for (std::size_t i = 0; i < free.state().particles.positions.size(); ++i)
          moved = std::max(moved, std::abs(free.state().particles.positions[i] -
                                           own.state().particles.positions[i]));
        EXPECT_GT(moved, 0.1);
      }
}

TEST(AddedForces, ActWithTheValuesThatTheyHaveWhenAStepBegins) {
  // A force that depends on the place, in steps of first order: v += h f(x)/m, then x += h v.
  Setting setting;
  setting.time_step = 0.125;
  State state = no_particles(2);
  add_particle(state, {1, 0, 0}, 0.1, 2);
  Simulation simulation(setting, state, 1);
  double x = 1, v = 0;
  for (int step = 0; step < 100; ++step) {
    simulation.added_forces()[0] = -8 * simulation.state().particles.positions[0];
    simulation.step(1e9);
    v += 0.125 * (-8 * x) / 2;
    x += 0.125 * v;
    // Powers of two are exact, but the products of the simulation are in another order.
    ASSERT_NEAR(simulation.state().particles.positions[0], x, 1e-13);
  }
  simulation.added_forces()[0] = 0;
  const double before = simulation.state().particles.velocities[0];
  simulation.step(1e9);
  EXPECT_EQ(simulation.state().particles.velocities[0], before);
}

TEST(AddedForces, AStepThatThrowsLeavesTheArraysWhereTheyAre) {
  // Two discs that meet off the centre at 5 radii a step, so that the step is divided.
  State state = no_particles(2);
  add_particle(state, {-3, 1.2, 0}, 1, 1, {5, 0, 0});
  add_particle(state, {0, 0, 0}, 1, 1);
  Setting setting;
  setting.time_step = 1;
  EXPECT_GT(Simulation(setting, state, 1).step(1e9).parts, 1);
  // A third one leaves the range of positions before the last part of the step.
  const double largest = largest_resolved_distance(setting.solver.tolerance, 1);
  add_particle(state, {0.95 * largest, 0, 0}, 1, 1, {0.2 * largest, 0, 0});
  Simulation simulation(setting, state, 1);
  const double* place = simulation.state().particles.positions.data();
  EXPECT_THROW(simulation.step(1e9), std::runtime_error);
  EXPECT_EQ(simulation.state().particles.positions, state.particles.positions);
  EXPECT_EQ(simulation.state().particles.velocities, state.particles.velocities);
  EXPECT_EQ(simulation.state().particles.positions.data(), place);
  // The caller turns it back.
  simulation.added_forces()[4] = -0.6 * largest;
  simulation.step(1e9);
  EXPECT_EQ(simulation.state().particles.positions.data(), place);
  EXPECT_LT(simulation.state().particles.positions[4], 0.95 * largest);
}

TEST(AddedForces, ActInAFluid) {
  for (const double mass : {0.0, 2.0}) {
    const auto system = [&](bool in_case) {
      auto made = in_fluid(2, 100, 0.1, 0.01);
      for (const double x : {-5.0, 0.0, 5.0}) add_disc(made, {x, 0, 0}, mass, {0, 0, 0});
      if (in_case) set_in_case(made.setting);
      return made;
    };
    auto with_forces = system(true), without = system(false);
    auto of_case = with_forces.simulation(constant_drag(3));
    auto own = without.simulation(constant_drag(3));
    set_added(own);
    run(of_case, 2);
    run(own, 2);
    expect_same_bits(own.state().particles, of_case.state().particles);
    EXPECT_GT(std::abs(own.state().particles.positions[1]), 0.1);
  }
}

TEST(AddedForces, OfDrivenParticlesHaveNoEffect) {
  const auto driven = [] {
    auto made = in_fluid(2, 100, 0.1, 0.01);
    add_disc(made, {0, 0, 0}, 0, {0, 0, 0});
    made.setting.given_motions[0] = {constant({1, 0, 0}), constant({})};
    return made;
  };
  auto one = driven(), other = driven();
  auto with_force = one.simulation(constant_drag(3)), without = other.simulation(constant_drag(3));
  with_force.added_forces()[1] = 5;
  run(with_force, 1);
  run(without, 1);
  expect_same_bits(with_force.state().particles, without.state().particles);
  EXPECT_EQ(with_force.fluid_forces(), without.fluid_forces());
}

}  // namespace
}  // namespace viscontact::particles
