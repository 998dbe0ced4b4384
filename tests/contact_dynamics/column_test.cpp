// A column on a floor: each contact carries all that is above it.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

State column(int dimension, int count, double gap) {
  State state = no_particles(dimension);
  for (int k = 0; k < count; ++k) add_particle(state, {0, 1 + gap + (2 + gap) * k, 0}, 1, 1);
  return state;
}

Setting on_the_floor(double h) {
  Setting setting;
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.gravity = {0, -1, 0};
  setting.time_step = h;
  setting.solver.tolerance = 1e-12;
  setting.solver.max_iterations = 100'000;
  return setting;
}

/// Contact forces over the weight of one: n at the floor, then n - 1, ..., 1.
void expect_weights(const State& state, int count, double h, double tolerance) {
  EXPECT_NEAR(pair_of(state, -1, 0).impulse / h, count, tolerance);
  for (int k = 1; k < count; ++k)
    EXPECT_NEAR(pair_of(state, k - 1, k).impulse / h, count - k, tolerance) << k;
}

/// Of forces, when every gap is within the solver's tolerance: W is h/m times the matrix of second
/// differences with one end free, whose inverse has row sums up to n (n + 1)/2; gaps h^2 times
/// forces. And gaps are rounded, heights 2 n.
double tolerance_of(const Setting& setting, int count) {
  const double gaps = setting.solver.tolerance + 2.0 * count * 4e-16;
  return gaps * count * (count + 1) / 2 / (setting.time_step * setting.time_step);
}

class Column : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Column, ::testing::Values(2, 3));

TEST_P(Column, ThatHasFallenCarriesItsWeights) {
  for (const int count : {2, 10}) {
    SCOPED_TRACE(count);
    auto setting = on_the_floor(0.02);
    setting.laws.film.gamma_min = 0;
    const double tolerance = tolerance_of(setting, count);
    Simulation simulation(setting, column(GetParam(), count, 0.01), 1);
    run(simulation, 1.5, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    expect_weights(simulation.state(), count, setting.time_step, tolerance);
    EXPECT_LE(kinetic_energy(simulation.state().particles), 1e-12);
  }
}

/// In a chain of ten contacts that close at once Newton's method comes first.
TEST_P(Column, IsSolvedByNewtonsMethod) {
  auto setting = on_the_floor(0.02);
  setting.laws.film.gamma_min = 0;
  Simulation simulation(setting, column(GetParam(), 10, 0), 1);
  const auto report = simulation.step(1);
  EXPECT_TRUE(report.converged);
  EXPECT_TRUE(report.solver_stages.starts_with("newton:")) << report.solver_stages;
}

}  // namespace
}  // namespace viscontact::particles
