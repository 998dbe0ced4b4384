// The benchmark box2d to rest, N = 200.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/contact_dynamics/box2d/box2d_case.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Every pair, not only those in the list.
double largest_overlap_of_all(const State& state) {
  double largest = 0;
  const auto count = static_cast<std::int32_t>(state.particles.count());
  for (std::int32_t i = 0; i < count; ++i)
    for (std::int32_t j = i + 1; j < count; ++j)
      largest = std::max(largest, -pair_gap(state, i, j));
  return largest / mean_radius(state.particles);
}

TEST(Box2d, ComesToRestWithoutOverlapsAndEveryStepConverges) {
  constexpr int kCount = 200;
  const auto setting = box(kCount);
  Simulation simulation(setting, particles_in_box(kCount), 1);
  const auto& state = simulation.state();
  double before = 0, after = 0, highest = 0;
  run(simulation, 30, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time;
    EXPECT_LE(report.residual, 1e-6) << report.time;
    // A gap is no less than the linearised one, which is within the tolerance; the rest is rounding
    // of heights up to 30.
    EXPECT_LE(largest_overlap(setting, state), 1e-6 + 1e-13) << report.time;
    if (state.steps % 20 == 0) {
      EXPECT_LE(largest_overlap_of_all(state), 1e-6 + 1e-13) << report.time;
    }
    const double energy = kinetic_energy(state.particles);
    ASSERT_TRUE(std::isfinite(energy));
    highest = std::max(highest, energy);
    if (report.time > 20)
      (report.time < 25 ? before : after) = std::max(report.time < 25 ? before : after, energy);
  });
  // What is left slides and settles: 0.13, then 0.007, of 218 in the fall.
  EXPECT_LT(before, 2e-3 * highest);
  EXPECT_LE(after, before);
  for (std::size_t k = 0; k < kCount; ++k) EXPECT_GT(state.particles.position(k)[1], 0) << k;
}

}  // namespace
}  // namespace viscontact::particles
