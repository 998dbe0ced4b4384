// gamma against balance of forces, for any loads, steps, masses and radii.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

/// A chain along `axis` that touches: particle k has the radius radii[k]; the first touches 0.
State chain(int dimension, const std::vector<double>& radii, const std::vector<double>& masses,
            std::size_t axis) {
  State state = no_particles(dimension);
  double end = 0;
  for (std::size_t k = 0; k < radii.size(); ++k) {
    Vector centre{};
    centre[axis] = end + radii[k];
    end += 2 * radii[k];
    add_particle(state, centre, radii[k], masses[k]);
  }
  return state;
}

TEST(ImpulseAccuracy, TwoDiscsPushedTogetherRememberThePush) {
  struct Case {
    double force, h;
    int steps;
  };
  for (const auto& [force, h, steps] :
       {Case{0.01, 1e-2, 100}, Case{0.01, 1e-3, 1000}, Case{0.01, 1e-4, 10'000},
        Case{0.01, 1e-5, 100'000}, Case{1e-6, 1e-2, 100}, Case{1e-12, 1e-6, 1000}}) {
    SCOPED_TRACE(testing::Message() << force << ' ' << h);
    Setting setting;
    setting.time_step = h;
    setting.forces[0] = constant({force, 0, 0});
    setting.forces[1] = constant({-force, 0, 0});
    Simulation simulation(setting, chain(2, {1, 1}, {1, 1}, 0), 1);
    take_steps(simulation, steps);
    const auto pair = pair_of(simulation.state(), 0, 1);
    // Of sums of so many numbers.
    EXPECT_NEAR(pair.gamma / (force * h * steps), -1, 1e-10);
    // What the residuals allow it to be wrong by is no more than was asked for.
    EXPECT_LE(pair.gamma_error, setting.solver.impulse_tolerance * force * h * steps);
  }
}

TEST(ImpulseAccuracy, RowThatIsPushedSharesThePush) {
  constexpr int kCount = 300;
  Setting setting;
  setting.time_step = 0.01;
  setting.forces[0] = constant({1, 0, 0});
  Simulation simulation(setting, chain(2, std::vector(kCount, 1.0), std::vector(kCount, 1.0), 0),
                        1);
  EXPECT_LE(take_steps(simulation, 100), 60);
  // All go together: a contact moves what is beyond it.
  for (int k = 1; k < kCount; ++k)
    EXPECT_NEAR(pair_of(simulation.state(), k - 1, k).gamma * kCount / -(kCount - k), 1,
                10 * setting.solver.impulse_tolerance)
        << k;
}

class LongChain : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, LongChain, ::testing::Values(2, 3));

TEST_P(LongChain, StandsHangsAndIsPushedInTensOfIterations) {
  constexpr int kCount = 10'000, kSteps = 3;
  const std::vector<double> ones(kCount, 1.0);
  const double h = 0.01, t = kSteps * h;
  {
    SCOPED_TRACE("column");
    Setting setting;
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.gravity = {0, -1, 0};
    setting.time_step = h;
    Simulation simulation(setting, chain(GetParam(), ones, ones, 1), 1);
    EXPECT_LE(take_steps(simulation, kSteps), 60);
    for (const int k : {0, 1, 10, 5000, 9999})
      EXPECT_NEAR(pair_of(simulation.state(), k == 0 ? -1 : k - 1, k).gamma / (-(kCount - k) * t),
                  1, 1e-8)
          << k;
  }
  {
    SCOPED_TRACE("hangs");
    // Pressed against a ceiling for a step, then pulled by gravity: films hold it.
    Setting setting;
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.gravity = {0, -100, 0};
    setting.time_step = h;
    Simulation press(setting, chain(GetParam(), ones, ones, 1), 1);
    EXPECT_LE(take_steps(press, 1), 60);
    setting.gravity = {0, 1, 0};  // away from the plane
    Simulation hang(setting, press.state(), 1);
    EXPECT_LE(take_steps(hang, kSteps), 60);
    for (const int k : {0, 1, 10, 5000, 9999})
      EXPECT_NEAR(
          pair_of(hang.state(), k == 0 ? -1 : k - 1, k).gamma / (-(kCount - k) * (100 * h - t)), 1,
          1e-8)
          << k;
  }
  {
    SCOPED_TRACE("pushed");
    Setting setting;
    setting.time_step = h;
    setting.forces[0] = constant({0, 1, 0});
    Simulation simulation(setting, chain(GetParam(), ones, ones, 1), 1);
    EXPECT_LE(take_steps(simulation, kSteps), 60);
    for (const int k : {1, 10, 5000, 9999})
      EXPECT_NEAR(pair_of(simulation.state(), k - 1, k).gamma * kCount / (-(kCount - k) * t), 1,
                  1e-8)
          << k;
  }
}

/// Discs in rows of `width` and `width - 1` in turn between two walls, each row in the hollows of
/// the one below.
State heap(int width, int rows, double r, double mass) {
  State state = no_particles(2);
  for (int row = 0; row < rows; ++row)
    for (int k = 0; k < width - row % 2; ++k)
      add_particle(state, {r * (1 + 2 * k + row % 2), r * (1 + row * std::sqrt(3.0)), 0}, r, mass);
  return state;
}

Setting box_of(double width, double gravity, double h) {
  Setting setting;
  setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({}, {1, 0, 0}),
                    plane_at_rest({width, 0, 0}, {-1, 0, 0})};
  setting.gravity = {0, -gravity, 0};
  setting.time_step = h;
  return setting;
}

/// What the films have taken from each particle, over m g t: 1 upwards if it is at rest.
Vector taken(const State& state, const std::vector<Plane>& planes, std::int32_t particle) {
  Vector sum{};
  const auto& p = state.particles;
  for (const auto& pair : state.walls)
    if (pair.second == particle)
      sum = sum - pair.gamma * planes[static_cast<std::size_t>(-1 - pair.first)].start.normal;
  for (const auto& pair : state.pairs) {
    if (pair.first != particle && pair.second != particle) continue;
    const Vector apart = p.position(static_cast<std::size_t>(pair.second)) -
                         p.position(static_cast<std::size_t>(pair.first));
    const double sign = pair.second == particle ? -1 : 1;
    sum = sum + (sign * pair.gamma / norm(apart)) * apart;
  }
  return sum;
}

TEST(ImpulseAccuracy, HeapsBalanceAnyLoadAtAnyStep) {
  Random random(15);
  for (int i = 0; i < 60; ++i) {
    const double r = random.decades(-3, 3), mass = random.decades(-3, 3);
    const double load = random.decades(-12, 6), h = random.decades(-6, 0);
    const int width = random.integer(2, 6), rows = random.integer(1, 6), steps = 20;
    SCOPED_TRACE(testing::Message() << i << ": r " << r << ", m " << mass << ", load " << load
                                    << ", h " << h << ", " << width << " x " << rows);
    const auto setting = box_of(2 * r * width, load / mass, h);
    Simulation simulation(setting, heap(width, rows, r, mass), 1);
    // A heavy load in a long step goes far in it, and is held all the same.
    take_steps(simulation, steps);
    const double all = load * h * steps;
    for (std::size_t k = 0; k < simulation.state().particles.count(); ++k) {
      const auto sum = taken(simulation.state(), setting.planes, static_cast<std::int32_t>(k));
      EXPECT_NEAR(sum[0] / all, 0, 1e-6) << k;
      EXPECT_NEAR(sum[1] / all, 1, 1e-6) << k;
    }
    EXPECT_LE(largest_overlap(setting, simulation.state()), setting.solver.tolerance);
  }
}

TEST(ImpulseAccuracy, ChainsAndColumnsOfAnyMassesAndRadii) {
  Random random(16);
  for (int i = 0; i < 100; ++i) {
    const int dimension = random.integer(2, 3), count = random.integer(2, 30), steps = 10;
    const double h = random.decades(-6, 0), load = random.decades(-12, 6);
    const bool column = random.chance(0.5);
    std::vector<double> radii, masses;
    for (int k = 0; k < count; ++k) {
      radii.push_back(random.decades(-3, 3));
      masses.push_back(random.decades(-3, 3));
    }
    SCOPED_TRACE(testing::Message() << i << ": " << (column ? "column" : "chain") << " of " << count
                                    << ", h " << h << ", load " << load);
    Setting setting;
    setting.time_step = h;
    double all = std::accumulate(masses.begin(), masses.end(), 0.0);
    if (column) {
      setting.planes = {plane_at_rest({}, {0, 1, 0})};
      setting.gravity = {0, -load, 0};
    } else {
      setting.forces[0] = constant({0, load, 0});
    }
    Simulation simulation(setting, chain(dimension, radii, masses, 1), 1);
    take_steps(simulation, steps);
    double beyond = all;
    for (int k = 0; k < count; ++k) {
      const double solid_load = column ? load * beyond : load * beyond / all;
      if (column || k > 0) {
        const auto pair = pair_of(simulation.state(), k == 0 ? -1 : k - 1, k);
        EXPECT_NEAR(pair.gamma / (solid_load * h * steps), -1, 1e-6) << k;
      }
      beyond -= masses[static_cast<std::size_t>(k)];
    }
    EXPECT_LE(largest_overlap(setting, simulation.state()), setting.solver.tolerance);
  }
}

TEST(ImpulseAccuracy, PairsOfDifferentLoadsDoNotDisturbEachOther) {
  Setting setting;
  setting.time_step = 1e-3;
  State state = no_particles(2);
  const std::vector<double> loads = {1e6, 1, 1e-6, 1e-12};
  for (std::size_t pair = 0; pair < loads.size(); ++pair) {
    const double y = 3.0 * static_cast<double>(pair);
    const auto first = static_cast<std::int32_t>(state.particles.count());
    add_particle(state, {-1, y, 0}, 1, 1);
    add_particle(state, {1, y, 0}, 1, 1);
    setting.forces[first] = constant({loads[pair], 0, 0});
    setting.forces[first + 1] = constant({-loads[pair], 0, 0});
  }
  Simulation simulation(setting, state, 1);
  take_steps(simulation, 100);
  for (std::size_t pair = 0; pair < loads.size(); ++pair) {
    const auto first = static_cast<std::int32_t>(2 * pair);
    EXPECT_NEAR(pair_of(simulation.state(), first, first + 1).gamma / (0.1 * loads[pair]), -1, 1e-8)
        << loads[pair];
  }
}

}  // namespace
}  // namespace viscontact::particles
