// Flows that reverse, stop and oscillate.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/suspensions/spheres.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

constexpr double kSide = 8.5;

State crowd() {
  Random random(31);
  return random_spheres(kSide, 1, two_sizes(26), 0.011, random);
}

FlowPiece shear_to(double until, double rate) {
  FlowPiece piece;
  piece.until = until;
  piece.gradient[0][1] = rate;
  return piece;
}

Setting sheared(const StepKind& kind) {
  auto setting = sheared_cube(kSide, 1, kind);
  setting.time_step = 0.02;
  return setting;
}

void run_to(SuspensionSimulation& simulation, double end) {
  while (simulation.step(end).parts > 0) continue;
}

TEST(FlowInTime, ReversesAndStops) {
  auto setting = sheared({PairTerms::kNearContact, 1e-3, 1e-3, 0});
  setting.lubrication->pieces = {shear_to(1, 1), shear_to(1.2, -2), shear_to(1.3, 0)};
  SuspensionSimulation simulation(setting, crowd(), 1);
  const auto run_until = [&](double end) {
    while (simulation.step(end).parts > 0)
      EXPECT_GT(simulation.rheology().smallest_gap, 1e-3 - 1e-7);
  };
  run_until(1);
  EXPECT_NEAR(simulation.state().shear.strain, 1, 1e-12);
  EXPECT_NEAR(simulation.state().shear.offset, 1, 1e-11);
  const double before = simulation.rheology().viscosity_contact;
  simulation.step(1.02);
  // Contacts that pushed open at once.
  EXPECT_GT(before, 0);
  EXPECT_LT(simulation.rheology().viscosity_contact, 0.5 * before);
  EXPECT_NEAR(simulation.rheology().shear_rate, -2, 1e-12);
  run_until(1.2);
  EXPECT_NEAR(simulation.state().shear.strain, 1.4, 1e-12);
  EXPECT_NEAR(simulation.state().shear.net_strain, 0.6, 1e-12);
  EXPECT_NEAR(simulation.state().shear.offset, 1 - 0.4 * kSide, 1e-11);
  run_until(1.3);
  EXPECT_NEAR(simulation.state().shear.strain, 1.4, 1e-12);
  EXPECT_EQ(simulation.rheology().shear_rate, 0);
}

TEST(FlowInTime, EndsStepsWhereItChanges) {
  auto setting = sheared({PairTerms::kNearContact, 1e-3, 0, 0});
  setting.lubrication->pieces = {shear_to(0.05, 1), shear_to(0.071, 1), shear_to(0.093, -1)};
  SuspensionSimulation simulation(setting, crowd(), 1);
  std::vector<double> times;
  while (simulation.step(0.13).parts > 0) times.push_back(simulation.state().time);
  // 0.05 is no change, and after 0.071 steps end on their grid again.
  const std::vector<double> expected{0.02, 0.04, 0.06, 0.071, 0.08, 0.1, 0.12, 0.13};
  ASSERT_EQ(times.size(), expected.size());
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-12);
  EXPECT_NEAR(simulation.state().shear.net_strain, 0.071 - (0.13 - 0.071), 1e-12);
}

TEST(FlowInTime, ThatEndsAStepEarlyDoesNotShortenTheNextOnes) {
  // Only the halving of a step with friction does.
  const State apart = spheres_at({{1, 2, 1}, {1, 6, 5}}, {1, 1});
  const auto times_of = [&](const Setting& setting, std::vector<double> ends) {
    SuspensionSimulation simulation(setting, apart, 1);
    std::vector<double> times;
    for (const double end : ends)
      while (simulation.step(end).parts > 0) times.push_back(simulation.state().time);
    return times;
  };
  auto setting = sheared({PairTerms::kNearContact, 1e-3, 1e-3, 0.5});
  const auto expect = [](const std::vector<double>& times, const std::vector<double>& expected) {
    ASSERT_EQ(times.size(), expected.size());
    for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], expected[k], 1e-12);
  };
  expect(times_of(setting, {0.02005, 0.07}), {0.02, 0.02005, 0.04005, 0.06005, 0.07});
  // A piece as short as that, and a piece that begins as shortly before a point of the grid.
  setting.lubrication->pieces = {shear_to(0.02, 1), shear_to(0.02005, -1), shear_to(0.05995, 1),
                                 shear_to(1, -1)};
  expect(times_of(setting, {0.1}), {0.02, 0.02005, 0.04, 0.05995, 0.06, 0.08, 0.1});
}

TEST(FlowInTime, HasAStepInEachPiece) {
  // Pieces of the least length, at a point of the grid of steps and at other places around it.
  auto setting = sheared({PairTerms::kNearContact, 1e-3, 0, 0});
  const double least = StepGrid::least_piece(setting.time_step);
  const auto with_piece = [&](double begin, double length) {
    setting.lubrication->pieces = {shear_to(begin, 1), shear_to(begin + length, 1e5),
                                   shear_to(1, 1)};
    return SuspensionSimulation(setting, spheres_at({Vector{1, 2, 3}}, {1}), 1);
  };
  for (const double shift : {-1.0, -0.75, -0.5, -0.25, 0.0, 0.25})
    for (const double point : {0.04, 0.05}) {
      auto simulation = with_piece(point + shift * least, (1 + 1e-9) * least);
      run_to(simulation, 0.1);
      // It takes a half to one and a half of the length, because times that differ less are the
      // same.
      EXPECT_NEAR(simulation.state().shear.strain, 0.1 + 1e5 * least, 0.51 * 1e5 * least) << shift;
    }
  EXPECT_THROW(with_piece(0.05, 0.9 * least), Error);
}

TEST(FlowInTime, ChangesItsGradient) {
  auto setting = sheared({PairTerms::kTables, 0, 0, 0});
  setting.domain = {};
  FlowPiece strain, turn;
  strain.until = 0.5;
  strain.gradient = {Vector{0.5, 0, 0}, Vector{0, -0.5, 0}, Vector{}};
  turn.until = 1;
  turn.gradient = {Vector{0, -1, 0}, Vector{1, 0, 0}, Vector{}};
  setting.lubrication->pieces = {strain, turn};
  SuspensionSimulation simulation(setting, spheres_at({{3, 4, 1}}, {1}), 1);
  run_to(simulation, 0.5);
  EXPECT_NEAR(simulation.state().shear.strain, 0.5, 1e-12);
  const Vector x = simulation.state().particles.position(0);
  EXPECT_NEAR(x[0], 3 * std::exp(0.25), 1e-12);
  EXPECT_NEAR(x[1], 4 * std::exp(-0.25), 1e-12);
  run_to(simulation, 1);
  const Vector y = simulation.state().particles.position(0);
  EXPECT_NEAR(y[0], x[0] * std::cos(0.5) - x[1] * std::sin(0.5), 1e-12);
  EXPECT_NEAR(y[1], x[0] * std::sin(0.5) + x[1] * std::cos(0.5), 1e-12);
  EXPECT_NEAR(simulation.state().particles.angular_velocities[2], 1, 1e-12);
  // A rotation is no strain.
  EXPECT_NEAR(simulation.state().shear.strain, 0.5, 1e-12);
}

TEST(FlowInTime, IsContinuedBitForBitAcrossAChange) {
  for (const bool is_wave : {false, true})
    for (const double friction : {0.0, 0.3}) {
      auto setting = sheared({PairTerms::kTables, 0, 1e-2, friction});
      if (is_wave)
        setting.lubrication->wave = Wave{0, 1.5, 6, 0.3};
      else
        setting.lubrication->pieces = {shear_to(0.31, 1), shear_to(0.37, -1), shear_to(1, 0.5)};
      SuspensionSimulation whole(setting, crowd(), 1);
      for (int n = 0; n < 30; ++n) {
        SuspensionSimulation rest(setting, whole.state(), 1);
        whole.step(10);
        rest.step(10);
        ASSERT_EQ(whole.state().particles.positions, rest.state().particles.positions) << n;
        ASSERT_EQ(whole.state().particles.velocities, rest.state().particles.velocities);
        ASSERT_EQ(whole.state().pairs, rest.state().pairs);
        ASSERT_EQ(whole.state().shear, rest.state().shear);
      }
    }
}

TEST(FlowInTime, OfAWaveHasTheStrainOfTheWave) {
  auto setting = sheared({PairTerms::kNearContact, 1e-3, 1e-3, 0.3});
  const Wave wave{0.2, 1.5, 5, 0.3};
  setting.lubrication->wave = wave;
  SuspensionSimulation simulation(setting, crowd(), 1);
  const double end = 2.2;
  run_to(simulation, end);
  EXPECT_NEAR(simulation.state().shear.strain, wave.path_until(end), 1e-12);
  EXPECT_NEAR(simulation.state().shear.net_strain, end * wave.mean_over(0, end), 1e-12);
}

TEST(FlowInTime, OfASmallWaveIsViscousAndInPhase) {
  // Smooth spheres at nearly the same places: the stress follows the rate without a lag. In steps
  // of a hundredth of the period the means of both are those of the same times.
  for (const auto pairs : {PairTerms::kTables, PairTerms::kNearContact}) {
    auto setting = sheared({pairs, 1e-3, 0, 0});
    const double amplitude = 1e-5, frequency = 2 * std::numbers::pi;
    setting.lubrication->wave = Wave{0, amplitude * frequency, frequency, 0.1};
    setting.time_step = 0.01;
    SuspensionSimulation simulation(setting, crowd(), 1);
    const double viscosity = simulation.solve_instant().viscosity;
    double in_phase = 0, out_of_phase = 0, time = 0;
    while (simulation.step(1).parts > 0) {
      const auto& rheology = simulation.rheology();
      const double middle = (time + simulation.state().time) / 2;
      const double stress = rheology.viscosity * simulation.state().shear.rate;
      const double h = simulation.state().time - time;
      in_phase += 2 * h * stress * std::sin(frequency * middle + 0.1);
      out_of_phase += 2 * h * stress * std::cos(frequency * middle + 0.1);
      time = simulation.state().time;
    }
    // Means over a step have this part of the amplitude.
    const double mean = std::sin(frequency * 0.005) / (frequency * 0.005);
    // The least gaps are some hundredths, of which the strain changes less than 1e-3.
    EXPECT_NEAR(in_phase / (viscosity * amplitude * frequency * mean), 1, 1e-3);
    EXPECT_NEAR(out_of_phase / in_phase, 0, 1e-3);
  }
}

TEST(FlowInTime, OfSmoothSpheresIsReversible) {
  // Forth and back by the strain 0.05. Steps take normals at half of the step, so that what is left
  // falls at least with the first order of the step.
  const auto left = [](double step) {
    auto setting = sheared({PairTerms::kTables, 0, 0, 0});
    setting.lubrication->pieces = {shear_to(0.05, 1), shear_to(0.1, -1)};
    setting.time_step = step;
    const State start = crowd();
    SuspensionSimulation simulation(setting, start, 1);
    run_to(simulation, 0.1);
    EXPECT_NEAR(simulation.state().shear.net_strain, 0, 1e-14);
    double square = 0;
    const auto& p = simulation.state().particles;
    for (std::size_t k = 0; k < p.count(); ++k) {
      Vector moved = p.position(k) - start.particles.position(k);
      for (auto& component : moved) component -= kSide * std::round(component / kSide);
      square += dot(moved, moved);
    }
    return std::sqrt(square / static_cast<double>(p.count()));
  };
  const double coarse = left(2e-3), middle = left(1e-3), fine = left(5e-4);
  EXPECT_LT(middle, 1.5e-4);
  // 2.00 and 2.35 here, where a pair comes within the range in some steps and not in others.
  EXPECT_NEAR(coarse / middle, 2, 0.2);
  EXPECT_GT(middle / fine, 1.8);
}

}  // namespace
}  // namespace viscontact::particles
