// Suspensions that come to rest, and settled beds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/particles/domain/domain.hpp"

namespace viscontact::particles {
namespace {

constexpr double kSide = 8.5;

const std::vector<StepKind> kRestingKinds{
    {PairTerms::kTables, 0, 0, 0},         {PairTerms::kNearContact, 0, 0, 0},
    {PairTerms::kNearContact, 1e-3, 0, 0}, {PairTerms::kTables, 0, 1e-2, 0},
    {PairTerms::kTables, 1e-3, 1e-2, 0.5}, {PairTerms::kNearContact, 0, 1e-2, 0.3},
    {PairTerms::kNone, 0, 0, 0},           {PairTerms::kNone, 0, 1e-3, 0.5},
};

enum class Flow : std::uint8_t { kRate, kStress, kExtension };

/// A flow until 0.2 that then stops, and goes back after 0.3.
Setting stopped(const StepKind& kind, Flow flow) {
  auto setting = sheared_cube(kSide, 0, kind);
  auto& of = *setting.lubrication;
  of.gradient = {};
  for (const auto& [until, factor] : {std::pair{0.2, 1.0}, {0.3, 0.0}, {0.4, -1.0}}) {
    auto& piece = of.pieces.emplace_back();
    piece.until = until;
    if (flow == Flow::kExtension) {
      piece.gradient[0][0] = factor;
      piece.gradient[1][1] = -factor;
    } else {
      piece.gradient[0][1] = flow == Flow::kStress ? 1 : factor;
    }
    if (flow == Flow::kStress) piece.stress = 5 * factor;
  }
  setting.time_step = 0.02;
  return setting;
}

State crowd_at_rest(std::uint64_t seed) {
  Random random(seed);
  return random_spheres(kSide, 0, two_sizes(26), 0.011, random);
}

double fastest(const SuspensionSimulation& simulation) {
  double most = 0;
  const auto& p = simulation.state().particles;
  for (std::size_t k = 0; k < p.count(); ++k) most = std::max(most, norm(p.velocity(k)));
  return most;
}

class FlowThatStops : public testing::TestWithParam<std::tuple<StepKind, Flow>> {};

TEST_P(FlowThatStops, LeavesSpheresAtRest) {
  const auto& [kind, flow] = GetParam();
  for (const std::uint64_t seed : {31U, 32U}) {
    SuspensionSimulation simulation(stopped(kind, flow), crowd_at_rest(seed), 1);
    const auto run_until = [&](double end) {
      for (;;) {
        const auto report = simulation.step(end);
        if (report.parts == 0) return;
        EXPECT_TRUE(report.converged) << simulation.state().time;
        EXPECT_GT(simulation.rheology().smallest_gap, kind.roughness - 1e-7);
      }
    };
    run_until(0.2);
    EXPECT_GT(simulation.rheology().shear_rate, 0.1);
    const auto before = simulation.state().particles.positions;
    run_until(0.3);
    // The last gaps of contacts may be wrong by 3e-8. The first step at rest mends them, and
    // spheres that hardly resist move farther.
    for (std::size_t i = 0; i < before.size(); ++i)
      EXPECT_NEAR(simulation.state().particles.positions[i], before[i], 1e-5);
    EXPECT_LT(fastest(simulation), 1e-9);
    EXPECT_EQ(simulation.rheology().shear_rate, 0);
    EXPECT_EQ(simulation.rheology().viscosity, 0);
    run_until(0.4);
    EXPECT_LT(simulation.rheology().shear_rate, -0.1);
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, FlowThatStops,
                         testing::Combine(testing::ValuesIn(kRestingKinds),
                                          testing::Values(Flow::kRate, Flow::kStress,
                                                          Flow::kExtension)));

TEST(FlowThatStopsInOtherUnits, IsTheSame) {
  const StepKind smooth{PairTerms::kTables, 0, 0, 0};
  // The gradient of a given stress is that at the rate 1 in any units.
  const auto rows = [&](double length, double time, double mass) {
    auto setting = stopped(smooth, Flow::kStress);
    auto& of = *setting.lubrication;
    of.viscosity *= mass / (length * time);
    for (auto& piece : of.pieces) {
      piece.until *= time;
      *piece.stress *= mass / (length * time * time);
    }
    setting.domain =
        BoxDomain{{}, {kSide * length, kSide * length, kSide * length}, {true, true, true}};
    setting.time_step *= time;
    SuspensionSimulation simulation(setting, scaled(crowd_at_rest(31), length), 1);
    std::vector<double> viscosities;
    while (simulation.step(0.4 * time).parts > 0)
      viscosities.push_back(simulation.rheology().viscosity);
    return viscosities;
  };
  const auto here = rows(1, 1, 1), small = rows(1e-6, 1e3, 1e-9), large = rows(1e5, 1e-4, 1e12);
  ASSERT_EQ(here.size(), 20U);
  ASSERT_EQ(small.size(), here.size());
  ASSERT_EQ(large.size(), here.size());
  for (std::size_t n = 0; n < here.size(); ++n) {
    // Five steps at rest. The steps after them begin with the rounding errors of rest, which change
    // the viscosities of most arrangements by 1e-8 to 2e-6.
    const double tolerance = (n < 10 ? 1e-11 : 1e-5) * here[n];
    EXPECT_EQ(here[n] == 0, n >= 10 && n < 15);
    EXPECT_NEAR(small[n], here[n], tolerance);
    EXPECT_NEAR(large[n], here[n], tolerance);
  }
}

}  // namespace
}  // namespace viscontact::particles
