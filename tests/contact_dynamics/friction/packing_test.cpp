// Packings to the accuracy "packing": what it promises, and what must hold at any accuracy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

struct Pile {
  double mu_s = 0.5, gamma_min = 0;
  FrictionMethod method = FrictionMethod::kConvex;
  double smallest = 0.7;  // radius; the largest is 1
};

Setting setting_of(const Pile& pile, int dimension) {
  Setting setting;
  setting.time_step = 0.05;
  setting.laws.film.gamma_min = pile.gamma_min;
  setting.laws.friction = FrictionLaw{pile.mu_s, pile.method};
  setting.solver = SolverSettings::for_packings();
  const auto down = static_cast<std::size_t>(dimension - 1);
  Vector normal{};
  normal[down] = 1;
  setting.gravity = -1 * normal;
  setting.planes = {plane_at_rest({}, normal)};
  for (std::size_t d = 0; d < down; ++d) {
    Vector side{};
    side[d] = 1;
    setting.planes.push_back(plane_at_rest({}, side));
    setting.planes.push_back(plane_at_rest(6 * side, -1 * side));
  }
  return setting;
}

/// Sixty particles on a lattice over the floor of a box of width 6, with random displacements.
State poured(const Pile& pile, int dimension) {
  Random random(11);
  State state = no_particles(dimension);
  const int columns = 3, layer = dimension == 2 ? columns : columns * columns;
  for (int k = 0; k < 60; ++k) {
    const auto jitter = [&] { return random.uniform(-0.05, 0.05); };
    const double radius = 0.9 * std::exp(random.uniform(std::log(pile.smallest), 0));
    Vector place{1 + 2.0 * (k % columns) + jitter()};
    if (dimension == 3) place[1] = 1 + 2.0 * (k % layer / columns) + jitter();
    place[static_cast<std::size_t>(dimension - 1)] = 1 + 2.0 * (k / layer) + jitter();
    add_particle(state, place, radius, std::pow(radius, dimension));
  }
  add_rotation(state.particles);
  return state;
}

/// The impulses of all contacts on each particle in the last step, whose normals are those of the
/// places `before` it.
std::vector<Vector> impulses_on(const Setting& setting, const State& state,
                                const Particles& before) {
  std::vector<Vector> sums(state.particles.count());
  for (const auto& contact : contacts_of(setting, state)) {
    Vector normal = contact.normal;
    if (contact.first >= 0) {
      normal = before.position(index_of(contact.second)) - before.position(index_of(contact.first));
      normal = (1 / norm(normal)) * normal;
    }
    const Vector impulse =
        setting.time_step * (contact.normal_force * normal + contact.tangential_force);
    if (contact.first >= 0) sums[index_of(contact.first)] = sums[index_of(contact.first)] - impulse;
    sums[index_of(contact.second)] = sums[index_of(contact.second)] + impulse;
  }
  return sums;
}

double energy_of(const Setting& setting, const Particles& p) {
  double energy = 0;
  for (std::size_t k = 0; k < p.count(); ++k) {
    energy +=
        p.masses[k] * (dot(p.velocity(k), p.velocity(k)) / 2 - dot(setting.gravity, p.position(k)));
    const std::size_t turns = turn_components(p.dimension);
    for (std::size_t i = 0; i < turns; ++i)
      energy += p.inertias[k] * p.angular_velocities[k * turns + i] *
                p.angular_velocities[k * turns + i] / 2;
  }
  return energy;
}

class Packing : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Packing, ::testing::Values(2, 3));

TEST_P(Packing, KeepsItsPromisesInEveryStep) {
  std::vector<Pile> piles;
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb})
    for (const double mu_s : {0.0, 0.3, 1.0})
      for (const double gamma_min : {0.0, -0.1}) piles.push_back({mu_s, gamma_min, method});
  piles.push_back({0.5, 0, FrictionMethod::kConvex, 0.1});
  for (const auto& pile : piles) {
    SCOPED_TRACE(::testing::Message() << "mu_s " << pile.mu_s << ", gamma_min " << pile.gamma_min
                                      << ", smallest radius " << pile.smallest);
    const auto setting = setting_of(pile, GetParam());
    Simulation simulation(setting, poured(pile, GetParam()), 1);
    const auto& state = simulation.state();
    std::size_t most = 0;
    const double layers = GetParam() == 2 ? 20 : 7;
    double least_energy = energy_of(setting, state.particles), weight = 0;
    for (const double mass : state.particles.masses) weight += mass;
    for (int n = 0; n < 300; ++n) {
      const auto before = state.particles;
      const auto report = simulation.step(100);
      most = std::max(most, report.contacts);
      EXPECT_TRUE(report.converged) << report.time;
      EXPECT_LE(report.largest_overlap, setting.solver.tolerance) << report.time;
      const auto& now = state.particles;
      const auto impulses = impulses_on(setting, state, before);
      for (std::size_t k = 0; k < now.count() && report.parts == 1; ++k) {
        const Vector given = now.masses[k] * (now.velocity(k) - before.velocity(k) -
                                              setting.time_step * setting.gravity);
        EXPECT_LE(norm(given - impulses[k]), 1e-12) << report.time << ", " << k;
      }
      // Where all overlaps of a stack are removed, the centre of mass rises by half of their sum.
      EXPECT_LE(energy_of(setting, now),
                least_energy + weight * setting.solver.tolerance * layers / 2)
          << report.time;
      least_energy = std::min(least_energy, energy_of(setting, now));
    }
    EXPECT_GT(most, 60U);
  }
}

/// The state after `steps` steps.
State after(const Setting& setting, const State& start, int steps) {
  Simulation simulation(setting, start, 1);
  for (int n = 0; n < steps; ++n) EXPECT_TRUE(simulation.step(1e6 * setting.time_step).converged);
  return simulation.state();
}

TEST_P(Packing, RollsAndSlidesInSmallSteps) {
  // A sphere that moves by 5e-5 radii in a step is slower than the tolerance, but it moves.
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb})
    for (const double mu_s : {0.0, 0.5}) {
      auto setting = setting_of({mu_s, 0, method}, GetParam());
      setting.time_step = 1e-3;
      State state = no_particles(GetParam());
      Vector place{3, 3, 3}, velocity{0.05};
      place[static_cast<std::size_t>(GetParam() - 1)] = 1;
      add_particle(state, place, 1, 1, velocity);
      add_rotation(state.particles);
      state.particles.angular_velocities[GetParam() == 2 ? 0 : 1] = GetParam() == 2 ? -0.05 : 0.05;
      const auto end = after(setting, state, 1000);
      EXPECT_NEAR(end.particles.positions[0], 3.05, 1e-6);
    }
}

TEST_P(Packing, PushesNothingThatDoesNotTouch) {
  // A sphere rests on the floor. A wall beside it, at a gap of 0.05, moves along itself. A plane
  // under a load lies on another sphere, so that this set is not solved by sweeps.
  for (const bool has_load : {false, true}) {
    auto setting = setting_of({}, GetParam());
    setting.time_step = 0.1;
    auto& wall = setting.planes[1];
    wall.start.point[0] = -0.05;
    const auto up = static_cast<std::size_t>(GetParam() - 1);
    Vector along{};
    along[up] = 2;
    wall.velocity = constant(along);
    State state = no_particles(GetParam());
    Vector place{1, 3, 3}, other{4, 3, 3};
    place[up] = other[up] = 1;
    add_particle(state, place, 1, 1);
    add_particle(state, other, 1, 1);
    add_rotation(state.particles);
    if (has_load) {
      Vector top{}, down{};
      top[up] = 2;
      down[up] = -1;
      auto plane = plane_at_rest(top, down);
      plane.load = PlaneLoad{.force = constant({1, 0, 0}), .mass = 1};
      setting.planes.push_back(plane);
    }
    const auto end = after(setting, state, 20);
    EXPECT_NEAR(end.particles.positions[0], 1, 1e-3) << has_load;
  }
}

TEST_P(Packing, DiffersFromFullAccuracyByItsTolerance) {
  auto setting = setting_of({}, GetParam());
  const auto start = after(setting, poured({}, GetParam()), 100);
  const auto fast = after(setting, start, 1);
  setting.solver = {};
  const auto exact = after(setting, start, 1);
  double largest = 0;
  for (std::size_t k = 0; k < fast.particles.positions.size(); ++k)
    largest =
        std::max(largest, std::abs(fast.particles.positions[k] - exact.particles.positions[k]));
  // Errors of the contacts of a stack of twenty particles add up.
  EXPECT_LE(largest, 20 * 1e-4);
  EXPECT_GT(largest, 1e-9);  // the two are not computed alike
}

TEST_P(Packing, ContinuesFromItsStateBitForBit) {
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb}) {
    const auto setting = setting_of({0.5, -0.1, method}, GetParam());
    const auto start = poured({}, GetParam());
    const auto whole = after(setting, start, 160);
    const auto continued = after(setting, after(setting, start, 110), 50);
    EXPECT_EQ(whole.particles.positions, continued.particles.positions);
    EXPECT_EQ(whole.particles.velocities, continued.particles.velocities);
  }
}

/// With Coulomb's law, and so few iterations that steps of poured() are divided.
Setting with_few_iterations(int dimension, int most) {
  auto setting = setting_of({1, 0, FrictionMethod::kCoulomb}, dimension);
  setting.solver.max_iterations = most;
  return setting;
}

TEST_P(Packing, DividesAStepAsIfShorterStepsWereAskedFor) {
  const auto setting = with_few_iterations(GetParam(), 100);
  auto in_halves = setting;
  in_halves.time_step /= 2;
  Simulation simulation(setting, poured({}, GetParam()), 1);
  int halved = 0;
  for (int n = 0; n < 150; ++n) {
    State start = no_particles(GetParam());
    start.particles = simulation.state().particles;
    simulation.step(100);
    // The first guesses of a state without impulses are the same in each step.
    Simulation whole(setting, start, 1);
    const auto report = whole.step(100);
    if (report.parts != 2) continue;
    ++halved;
    Simulation half(in_halves, start, 1);
    bool is_solved = true;
    for (int part = 0; part < 2; ++part) {
      const auto of_half = half.step(100);
      EXPECT_EQ(of_half.parts, 1) << n;
      is_solved = is_solved && of_half.converged;
    }
    EXPECT_EQ(report.converged, is_solved) << n;
    EXPECT_EQ(whole.state().particles.positions, half.state().particles.positions) << n;
    EXPECT_EQ(whole.state().particles.velocities, half.state().particles.velocities) << n;
    EXPECT_EQ(whole.state().particles.angular_velocities, half.state().particles.angular_velocities)
        << n;
  }
  EXPECT_GT(halved, 0);  // rounding errors decide how many
}

TEST_P(Packing, KeepsMomentumAndContinuesBitForBitWhereStepsAreDivided) {
  // Some steps are not solved in parts either.
  const auto setting = with_few_iterations(GetParam(), 40);
  Simulation simulation(setting, poured({}, GetParam()), 1);
  const auto& state = simulation.state();
  double mass = 0;
  for (const double m : state.particles.masses) mass += m;
  const auto momentum = [&] {
    Vector sum{};
    for (std::size_t k = 0; k < state.particles.count(); ++k)
      sum = sum + state.particles.masses[k] * state.particles.velocity(k);
    return sum;
  };
  int divided = 0, given = 0;
  State middle;
  for (int n = 0; n < 150; ++n) {
    if (n == 100) middle = state;
    const Vector before = momentum();
    const auto report = simulation.step(100);
    divided += report.parts > 1 ? 1 : 0;
    given += report.has_given_loads ? 1 : 0;
    // Impulses of all parts on the walls, whose normals stay, and of gravity. Forces are impulses
    // over the whole step.
    Vector change = (setting.time_step * mass) * setting.gravity;
    for (const auto& contact : contacts_of(setting, state))
      if (contact.first < 0)
        change = change + setting.time_step *
                              (contact.normal_force * contact.normal + contact.tangential_force);
    EXPECT_LE(norm(momentum() - before - change), 1e-12) << n;
  }
  EXPECT_GT(divided, 0);
  EXPECT_GT(given, 0);
  Simulation continued(setting, middle, 1);
  for (int n = 100; n < 150; ++n) continued.step(100);
  EXPECT_EQ(continued.state().particles.positions, state.particles.positions);
  EXPECT_EQ(continued.state().particles.velocities, state.particles.velocities);
}

TEST_P(Packing, IsTheSameInOtherUnits) {
  const auto setting = setting_of({}, GetParam());
  State start = no_particles(GetParam());
  start.particles = after(setting, poured({}, GetParam()), 100).particles;
  const auto plain = after(setting, start, 1).particles;
  Random random(5);
  for (int trial = 0; trial < 10; ++trial) {
    // Powers of 2 leave rounding errors as they are.
    const auto factor = [&] { return std::exp2(random.integer(-16, 16)); };
    const double length = factor(), mass = factor(), time = factor();
    auto in_units = setting;
    for (auto& plane : in_units.planes) plane.start.point = length * plane.start.point;
    in_units.gravity = (length / (time * time)) * in_units.gravity;
    in_units.time_step *= time;
    auto state = start;
    const auto scale = [](std::vector<double>& numbers, double by) {
      for (auto& number : numbers) number *= by;
    };
    scale(state.particles.positions, length);
    scale(state.particles.radii, length);
    scale(state.particles.masses, mass);
    scale(state.particles.inertias, mass * length * length);
    scale(state.particles.velocities, length / time);
    scale(state.particles.angular_velocities, 1 / time);
    const auto scaled = after(in_units, state, 1).particles;
    for (std::size_t k = 0; k < scaled.positions.size(); ++k)
      EXPECT_NEAR(scaled.positions[k] / length, plain.positions[k], 1e-12);
  }
}

TEST_P(Packing, DependsOnTheOrderOfParticlesByItsToleranceOnly) {
  const auto setting = setting_of({}, GetParam());
  State start = no_particles(GetParam());
  start.particles = after(setting, poured({}, GetParam()), 100).particles;
  const auto plain = after(setting, start, 1).particles;
  const std::size_t count = start.particles.count();
  auto reversed = no_particles(GetParam());
  for (std::size_t k = 0; k < count; ++k) {
    const auto& p = start.particles;
    const std::size_t from = count - 1 - k;
    add_particle(reversed, p.position(from), p.radii[from], p.masses[from], p.velocity(from));
  }
  add_rotation(reversed.particles);
  const std::size_t turns = turn_components(GetParam());
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < turns; ++i)
      reversed.particles.angular_velocities[k * turns + i] =
          start.particles.angular_velocities[(count - 1 - k) * turns + i];
  const auto other = after(setting, reversed, 1).particles;
  for (std::size_t k = 0; k < count; ++k)
    EXPECT_LE(norm(plain.position(k) - other.position(count - 1 - k)), 20 * 1e-4);
}

}  // namespace
}  // namespace viscontact::particles
