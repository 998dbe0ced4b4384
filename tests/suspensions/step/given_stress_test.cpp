// Steps whose shear stress is given, and whose rate is a result.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/common/failure.hpp"
#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

constexpr double kCube = 8.5;

const std::vector<StepKind> kStressedKinds{
    {PairTerms::kNearContact, 1e-3, 0, 0}, {PairTerms::kTables, 0, 0, 0},
    {PairTerms::kTables, 1e-3, 1e-2, 0.5}, {PairTerms::kNearContact, 0, 1e-2, 0.3},
    {PairTerms::kNone, 0, 0, 0},           {PairTerms::kNone, 0, 1e-3, 0.3},
};

Setting stressed(const StepKind& kind, double stress) {
  auto setting = sheared_cube(kCube, 1, kind);
  setting.lubrication->stress = stress;
  setting.time_step = 0.02;
  return setting;
}

State dense() {
  Random random(31);
  return random_spheres(kCube, 1, two_sizes(26), 0.011, random);
}

FlowPiece stress_to(double until, double stress) {
  FlowPiece piece;
  piece.until = until;
  piece.gradient[0][1] = 1;
  piece.stress = stress;
  return piece;
}

double stress_of(const SuspensionSimulation& simulation) {
  return simulation.rheology().viscosity * simulation.state().shear.rate;
}

TEST(GivenStress, IsRefusedBesidePlanes) {
  auto setting = stressed(kStressedKinds[0], 1);
  auto state = spheres_at({{2, 2, 2}}, {1});
  const auto start = [&] { SuspensionSimulation(setting, state, 1); };
  EXPECT_NO_THROW(start());
  setting.planes.emplace_back().start = {{}, {0, 1, 0}};
  EXPECT_EQ(bad_input(start).kind(), ErrorKind::kBadInput);
}

TEST(GivenStress, IsThatOfEachStep) {
  for (const auto& kind : kStressedKinds) {
    SCOPED_TRACE(&kind - kStressedKinds.data());
    for (const double stress : {7.0, -7.0}) {
      SuspensionSimulation simulation(stressed(kind, stress), dense(), 1);
      std::size_t touched = 0;
      for (int n = 0; n < 60; ++n) {
        const auto report = simulation.step(10);
        EXPECT_TRUE(report.converged);
        touched = std::max(touched, report.contacts);
        const auto& rheology = simulation.rheology();
        EXPECT_NEAR(stress_of(simulation), stress, 1e-8 * std::abs(stress));
        EXPECT_NEAR(rheology.shear_rate, simulation.state().shear.rate, 1e-12);
        EXPECT_GT(rheology.smallest_gap, kind.roughness - 1e-7);
      }
      EXPECT_EQ(simulation.state().shear.net_strain > 0, stress > 0);
      EXPECT_EQ(touched > 0,
                kind.regularisation > 0 || kind.roughness > 0 || kind.pairs == PairTerms::kNone);
    }
  }
}

TEST(GivenStress, HasTheMotionsOfAGivenRate) {
  for (const auto& kind : kStressedKinds) {
    SCOPED_TRACE(&kind - kStressedKinds.data());
    auto setting = stressed(kind, 7);
    // Both take the normals of half of the step by the motions after two linear problems, which
    // differ; in short steps these normals differ less.
    setting.time_step = 0.004;
    SuspensionSimulation simulation(setting, dense(), 1);
    for (int n = 0; n < 60; ++n) simulation.step(10);
    auto start = simulation.state();
    simulation.step(10);
    setting.lubrication->stress.reset();
    setting.lubrication->gradient[0][1] = simulation.state().shear.rate;
    start.shear.rate /= setting.lubrication->gradient[0][1];
    SuspensionSimulation given(setting, start, 1);
    given.step(10);
    EXPECT_NEAR(given.rheology().viscosity / simulation.rheology().viscosity, 1, 5e-6);
    double farthest = 0;
    for (std::size_t k = 0; k < 3 * start.particles.count(); ++k)
      farthest = std::max(farthest, std::abs(given.state().particles.positions[k] -
                                             simulation.state().particles.positions[k]));
    EXPECT_LT(farthest, 1e-5);
  }
}

TEST(GivenStress, IncludesThatOfTheRepulsion) {
  auto setting = stressed({PairTerms::kNearContact, 1e-3, 0, 0}, 7);
  setting.lubrication->repulsion = Repulsion{1, 0.02};
  SuspensionSimulation simulation(setting, dense(), 1);
  for (int n = 0; n < 10; ++n) {
    EXPECT_TRUE(simulation.step(10).converged);
    EXPECT_NEAR(stress_of(simulation), 7, 7e-8);
  }
  EXPECT_GT(simulation.state().shear.rate, 0.5);
}

TEST(GivenStress, OfZeroLetsTheSuspensionRelax) {
  auto setting = stressed({PairTerms::kNearContact, 1e-3, 1e-3, 0.3}, 0);
  setting.lubrication->repulsion = Repulsion{1, 0.05};
  SuspensionSimulation simulation(setting, dense(), 1);
  double first = 0;
  for (int n = 0; n < 200; ++n) {
    EXPECT_TRUE(simulation.step(100).converged);
    ASSERT_TRUE(std::isfinite(simulation.state().shear.rate));
    if (n == 0) first = simulation.rheology().smallest_gap;
    // The parts of the stress are of the order of the repulsion over an area, 1e-2.
    EXPECT_LT(std::abs(stress_of(simulation)), 1e-7);
  }
  // The repulsion opens the gaps.
  EXPECT_GT(simulation.rheology().smallest_gap, 1.05 * first);
}

TEST(GivenStress, OfZeroWithoutForcesIsRest) {
  SuspensionSimulation simulation(stressed({PairTerms::kTables, 0, 1e-2, 0.3}, 0), dense(), 1);
  const auto start = simulation.state().particles.positions;
  for (int n = 0; n < 3; ++n) EXPECT_TRUE(simulation.step(10).converged);
  EXPECT_EQ(simulation.state().shear.rate, 0);
  EXPECT_EQ(simulation.state().particles.positions, start);
}

TEST(GivenStress, ReversesAndOscillates) {
  auto setting = stressed({PairTerms::kTables, 1e-3, 1e-2, 0.3}, 0);
  setting.lubrication->pieces = {stress_to(0.5, 8), stress_to(0.81, -8), stress_to(0.9, 0),
                                 stress_to(1, 1)};
  SuspensionSimulation simulation(setting, dense(), 1);
  while (simulation.step(1).parts > 0) {
    const double time = simulation.state().time - 1e-6;
    const double stress = time < 0.5 ? 8 : time < 0.81 ? -8 : time < 0.9 ? 0 : 1;
    EXPECT_NEAR(stress_of(simulation), stress, 1e-7);
  }
  setting.lubrication->pieces.clear();
  setting.lubrication->stress = 1;
  const Wave wave{0, 6, 5, 0};
  setting.lubrication->wave = wave;
  SuspensionSimulation waving(setting, dense(), 1);
  for (int n = 0; n < 100; ++n) {
    waving.step(10);
    EXPECT_NEAR(stress_of(waving), wave.mean_over(n * 0.02, (n + 1) * 0.02), 1e-7);
  }
}

TEST(GivenStress, IsContinuedBitForBit) {
  auto setting = stressed({PairTerms::kTables, 1e-3, 1e-2, 0.3}, 1);
  setting.lubrication->wave = Wave{1, 6, 8, 0.2};
  SuspensionSimulation whole(setting, dense(), 1);
  for (int n = 0; n < 25; ++n) {
    SuspensionSimulation rest(setting, whole.state(), 1);
    whole.step(10);
    rest.step(10);
    ASSERT_EQ(whole.state().particles.positions, rest.state().particles.positions) << n;
    ASSERT_EQ(whole.state().pairs, rest.state().pairs);
    ASSERT_EQ(whole.state().shear, rest.state().shear);
  }
}

TEST(GivenStress, ThatSpheresBearWithoutMovingHasNoRate) {
  // A close-packed lattice of touching spheres cannot be sheared without growing.
  const double lattice = 2.0 * std::sqrt(2);
  std::vector<Vector> places;
  for (int cell = 0; cell < 8; ++cell) {
    const Vector from{lattice * (cell % 2), lattice * (cell / 2 % 2), lattice * (cell / 4)};
    for (const Vector& x : {Vector{0, 0, 0}, Vector{0, 1, 1}, Vector{1, 0, 1}, Vector{1, 1, 0}})
      places.push_back(from + (lattice / 2) * x);
  }
  auto setting = sheared_cube(2 * lattice, 0);
  setting.lubrication->range = 0.2;
  setting.lubrication->stress = 5;
  setting.time_step = 0.02;
  SuspensionSimulation simulation(setting,
                                  spheres_at(places, std::vector<double>(places.size(), 1)), 1);
  for (int n = 0; n < 10; ++n) {
    simulation.step(1);
    EXPECT_GT(simulation.rheology().smallest_gap, -1e-7);
    // The fluid alone would flow at the rate 5; residuals are compared with 1e-6 of its power.
    EXPECT_LT(std::abs(simulation.state().shear.rate), 1e-4);
  }
}

TEST(GivenStress, NeedsNoMuchLongerThanAGivenRate) {
  // From 0.95 to 1.37 of the iterations at the same rate here, and 2.2 with films that alone keep
  // smooth spheres apart, where some steps are halved.
  for (const auto& kind : kStressedKinds) {
    SCOPED_TRACE(&kind - kStressedKinds.data());
    auto setting = stressed(kind, 7);
    SuspensionSimulation by_stress(setting, dense(), 1);
    setting.lubrication->stress.reset();
    double by_rate_iterations = 0, by_stress_iterations = 0;
    for (int n = 0; n < 60; ++n) {
      State start = by_stress.state();
      by_stress_iterations += by_stress.step(10).iterations;
      setting.lubrication->gradient[0][1] = by_stress.state().shear.rate;
      start.shear.rate /= setting.lubrication->gradient[0][1];
      by_rate_iterations += SuspensionSimulation(setting, start, 1).step(10).iterations;
    }
    const bool are_kept_apart =
        kind.pairs == PairTerms::kTables && kind.regularisation == 0 && kind.roughness == 0;
    EXPECT_LT(by_stress_iterations, (are_kept_apart ? 3 : 1.6) * by_rate_iterations);
  }
}

}  // namespace
}  // namespace viscontact::particles
