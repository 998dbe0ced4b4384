// Impacts of smooth spheres with inertia, which films stop.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

constexpr double kGap = 0.3;

/// A sphere of radius 1 that comes with speed 1 to a plane, or to another sphere that is free.
SuspensionSimulation impact(bool has_plane, PairTerms pairs, double mass, double step) {
  Setting setting;
  PairLubrication lubrication;
  lubrication.viscosity = 1;
  lubrication.inertia = true;
  lubrication.range = 2;
  lubrication.pairs = pairs;
  setting.lubrication = lubrication;
  setting.time_step = step;
  State state;
  if (has_plane) {
    setting.planes.emplace_back().start = {{}, {0, 1, 0}};
    state = spheres_at({{0, 1 + kGap, 0}}, {1});
  } else {
    state = spheres_at({{0, 2 + kGap, 0}, {0, 0, 0}}, {1, 1});
  }
  auto& p = state.particles;
  for (std::size_t k = 0; k < p.count(); ++k) {
    p.masses[k] = mass;
    p.inertias[k] = 0.4 * mass;
  }
  p.velocities[1] = -1;
  return {setting, state, 1};
}

class ImpactOfSmoothSpheres : public testing::TestWithParam<std::tuple<bool, PairTerms>> {};

TEST_P(ImpactOfSmoothSpheres, EndsTheirApproachAtAnyStokesNumber) {
  const auto& [has_plane, pairs] = GetParam();
  for (const double step : {0.5, 0.05, 0.005})
    for (const double mass : {30.0, 100.0, 200.0, 300.0, 450.0, 600.0, 1e3, 1e4, 1e6}) {
      SCOPED_TRACE(testing::Message() << "mass " << mass << ", step " << step);
      auto simulation = impact(has_plane, pairs, mass, step);
      for (;;) {
        const auto report = simulation.step(1.5);
        if (report.parts == 0) break;
        EXPECT_TRUE(report.converged);
        EXPECT_GT(simulation.rheology().smallest_gap, -1e-7);
      }
      const auto& p = simulation.state().particles;
      // Spheres do not rebound, and what moves on is their middle.
      const double approach = has_plane ? p.velocity(0)[1] : p.velocity(0)[1] - p.velocity(1)[1];
      EXPECT_NEAR(approach, 0, 0.02);
      // St = m v/(6 pi mu a^2) for the plane. Free spheres with half the mass and a quarter of the
      // squeeze resistance have twice as much.
      const double stokes = (has_plane ? 1 : 2) * mass / (6 * M_PI);
      if (stokes > 20) {
        // A film whose gap is less counts as one of 1e-7 and opens again until it rests.
        EXPECT_LT(simulation.rheology().smallest_gap, 1e-6);
      }
      if (!has_plane) {
        // Only drag, at most 12 pi mu a of the pair, changes the momentum of both.
        const double momentum = (p.velocity(0)[1] + p.velocity(1)[1]) * mass;
        EXPECT_LT(momentum, 0);
        EXPECT_NEAR(momentum / -mass, 1, 12 * M_PI * 1.5 / mass + 1e-6);
      }
    }
}

INSTANTIATE_TEST_SUITE_P(Kinds, ImpactOfSmoothSpheres,
                         testing::Combine(testing::Bool(),
                                          testing::Values(PairTerms::kTables,
                                                          PairTerms::kNearContact)));

class FreeSpheres : public testing::TestWithParam<PairTerms> {};

TEST_P(FreeSpheres, KeepTheirMomentum) {
  Setting setting;
  PairLubrication lubrication;
  lubrication.viscosity = 1e-3;
  lubrication.inertia = true;
  lubrication.drag = 1e-10;
  lubrication.pairs = GetParam();
  if (lubrication.pairs == PairTerms::kNone) {
    lubrication.roughness = 1e-3;
    setting.laws.film.viscosity = lubrication.viscosity;
    setting.laws.film.roughness = 5e-4;
  }
  setting.lubrication = lubrication;
  setting.time_step = 0.1;
  Random random(63);
  const std::size_t count = 20;
  auto state = random_spheres(12, 0, two_sizes(count), 0.02, random);
  auto& p = state.particles;
  // They come together and go on as a whole.
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t d = 0; d < 3; ++d)
      p.velocities[3 * k + d] = 0.5 * (6 - p.positions[3 * k + d]) + random.uniform(-1, 1) + 0.5;
  const auto momentum = [&](const SuspensionSimulation& of) {
    Vector sum{};
    for (std::size_t k = 0; k < count; ++k)
      sum = sum + p.masses[k] * of.state().particles.velocity(k);
    return sum;
  };
  SuspensionSimulation simulation(setting, state, 1);
  const Vector start = momentum(simulation);
  bool have_met = false;
  while (simulation.step(3).parts > 0)
    have_met = have_met || simulation.rheology().smallest_gap < 2e-3;
  EXPECT_TRUE(have_met);
  // The drag of the whole takes less than 1e-10 of it.
  EXPECT_LT(norm(momentum(simulation) - start), 1e-9 * norm(start));
}

INSTANTIATE_TEST_SUITE_P(Kinds, FreeSpheres,
                         testing::Values(PairTerms::kTables, PairTerms::kNearContact,
                                         PairTerms::kNone));

TEST(ImpactOfASmoothSphere, ClosesTheGapOfItsStokesNumber) {
  // With the film alone v = v_0 - 6 pi mu a^2 ln(q_0/q)/m.
  for (const double mass : {60.0, 100.0, 150.0}) {
    auto simulation = impact(true, PairTerms::kNearContact, mass, 1e-3);
    while (simulation.step(1.5).parts > 0) continue;
    const double gap = simulation.state().particles.position(0)[1] - 1;
    const double of_film = mass / (6 * M_PI), of_gap = std::log(kGap / gap);
    // Drag and the logarithms of the near-contact terms take a part of the momentum.
    EXPECT_LT(of_gap, of_film);
    EXPECT_GT(of_gap, 0.8 * of_film - 1);
  }
}

}  // namespace
}  // namespace viscontact::particles
