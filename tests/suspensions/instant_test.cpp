// The instantaneous problem against a dense matrix, and its balance of power.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "tests/common/failure.hpp"
#include "tests/oracles/dense_suspension.hpp"
#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

oracles::DenseSuspension dense_of(const Setting& setting, const State& state) {
  oracles::DenseSuspension dense;
  const auto& of = *setting.lubrication;
  for (std::size_t k = 0; k < state.particles.count(); ++k) {
    const Vector x = state.particles.position(k);
    dense.positions.emplace_back(x[0], x[1], x[2]);
  }
  dense.radii = state.particles.radii;
  const auto periods = periods_of(setting.domain);
  dense.periods = {periods[0], periods[1], periods[2]};
  dense.offset = of.offset;
  dense.viscosity = of.viscosity;
  dense.range = of.range;
  dense.regularisation = of.regularisation;
  dense.drag = of.drag;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      dense.gradient(i, j) = of.gradient[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return dense;
}

void expect_motions(const SuspensionSimulation& simulation, const Setting& setting,
                    const Eigen::VectorXd& motions) {
  // Conjugate gradients end at 1e-11 of the dissipation, where motions have errors of 1e-10.
  const double bar = 1e-9 * motions.cwiseAbs().maxCoeff();
  for (std::size_t k = 0; k < simulation.state().particles.count(); ++k) {
    const auto motion = relative_motion(simulation, setting, k);
    for (std::size_t d = 0; d < 3; ++d) {
      EXPECT_NEAR(motion.along[d], motions[static_cast<Eigen::Index>(6 * k + d)], bar);
      EXPECT_NEAR(motion.turn[d], motions[static_cast<Eigen::Index>(6 * k + 3 + d)], bar);
    }
  }
}

void expect_stress(const Rheology& rheology, const Eigen::Matrix3d& stresslets, double viscosity,
                   double rate, double volume) {
  Eigen::Matrix3d stress = stresslets / (volume * viscosity * rate);
  EXPECT_NEAR(rheology.pressure, -stress.trace() / 3, 1e-9);
  EXPECT_NEAR(rheology.viscosity, 1 + (stress(0, 1) + stress(1, 0)) / 2, 1e-9);
  EXPECT_NEAR(rheology.n1, stress(0, 0) - stress(1, 1), 1e-9);
  EXPECT_NEAR(rheology.n2, stress(1, 1) - stress(2, 2), 1e-9);
}

TEST(Instant, HasTheMotionsAndTheStressOfADenseMatrix) {
  Random random(11);
  // With less drag the dense matrix loses digits of a translation of all spheres.
  for (const double drag : {1.0, 1e-3}) {
    const double period = 8.5, offset = random.uniform(-4, 4);
    const auto state = random_spheres(period, offset, two_sizes(26), 1e-4, random);
    auto setting = sheared_cube(period, offset);
    setting.lubrication->drag = drag;
    const auto expected = dense_of(setting, state).solve();
    SuspensionSimulation simulation(setting, state, 1);
    const auto& rheology = simulation.solve_instant();
    EXPECT_EQ(rheology.pairs, static_cast<std::size_t>(expected.pairs));
    EXPECT_GT(expected.pairs, 40);
    expect_motions(simulation, setting, expected.motions);
    expect_stress(rheology, expected.stresslets, 1, 1, std::pow(period, 3));
  }
}

TEST(Instant, HasTheRateThatBelongsToAStress) {
  Random random(12);
  const auto state = random_spheres(8.5, 1, two_sizes(26), 1e-3, random);
  auto setting = sheared_cube(8.5, 1);
  setting.lubrication->repulsion = Repulsion{30, 0.05};
  setting.added_forces.assign(78, 0);
  setting.added_torques.assign(78, 0);
  for (auto& force : setting.added_forces) force = random.uniform(-1, 1);
  for (auto& torque : setting.added_torques) torque = random.uniform(-1, 1);
  SuspensionSimulation with_rate(setting, state, 1);
  const auto given = with_rate.solve_instant();
  const auto motion = relative_motion(with_rate, setting, 7);
  for (const double factor : {1.0, 3.0}) {
    // With forces the stress is not proportional to the rate.
    auto flow = setting;
    flow.lubrication->gradient[0][1] = factor;
    flow.lubrication->stress.reset();
    SuspensionSimulation fast(flow, state, 1);
    const double stress = factor * fast.solve_instant().viscosity;
    setting.lubrication->stress = stress;
    SuspensionSimulation with_stress(setting, state, 1);
    const auto& found = with_stress.solve_instant();
    EXPECT_NEAR(found.shear_rate, factor, 1e-9 * factor);
    EXPECT_NEAR(found.viscosity * found.shear_rate, stress, 1e-9 * stress);
    EXPECT_NEAR(found.n1 * found.shear_rate, factor * fast.rheology().n1, 1e-8);
    if (factor == 1) {
      EXPECT_LT(norm(relative_motion(with_stress, setting, 7).along - motion.along), 1e-9);
      EXPECT_NEAR(found.pressure, given.pressure, 1e-9);
    }
  }
}

/// Power of the forces on the spheres and of the stress of their stresslets.
double power_of(const SuspensionSimulation& simulation, const Setting& setting, double volume) {
  double power = (simulation.rheology().viscosity - 1) * volume;
  for (std::size_t k = 0; k < simulation.state().particles.count(); ++k) {
    const auto motion = relative_motion(simulation, setting, k);
    power += dot(point_of(setting.added_forces.data(), k, 3), motion.along) +
             dot(point_of(setting.added_torques.data(), k, 3), motion.turn);
  }
  return power;
}

TEST(Instant, ObeysTheReciprocalTheorem) {
  // The power is a square form of flow and forces, so that it has the parallelogram law only if the
  // stress by forces belongs to the motion by the flow.
  Random random(13);
  for (const auto pairs : {PairTerms::kNearContact, PairTerms::kTables}) {
    const double period = 8.5, volume = std::pow(period, 3);
    const auto state = random_spheres(period, -2, two_sizes(26), 1e-3, random);
    auto setting = sheared_cube(period, -2);
    setting.lubrication->pairs = pairs;
    setting.added_forces.assign(78, 0);
    setting.added_torques.assign(78, 0);
    const auto power_with = [&](double rate, const std::vector<double>& forces) {
      setting.lubrication->gradient[0][1] = rate;
      std::ranges::copy(forces, setting.added_forces.begin());
      SuspensionSimulation simulation(setting, state, 1);
      simulation.solve_instant();
      return power_of(simulation, setting, rate * rate * volume);
    };
    std::vector<double> forces(78), none(78, 0.0), opposite(78);
    for (std::size_t k = 0; k < 78; ++k) {
      forces[k] = random.uniform(-20, 20);
      opposite[k] = -forces[k];
    }
    const double flow = power_with(1, none), by_forces = power_with(0, forces);
    EXPECT_GT(flow, 0);
    EXPECT_GT(by_forces, 0);
    EXPECT_NEAR(power_with(1, forces) + power_with(1, opposite), 2 * flow + 2 * by_forces,
                1e-9 * (flow + by_forces));
  }
}

TEST(Instant, OfADiluteSuspensionHasEinsteinsViscosityByTheTables) {
  auto setting = sheared_cube(20, 0);
  setting.lubrication->pairs = PairTerms::kTables;
  SuspensionSimulation simulation(setting, spheres_at({{3, 4, 5}, {13, 14, 15}}, {1, 1.4}), 1);
  const double fraction = 4 * M_PI / 3 * (1 + 1.4 * 1.4 * 1.4) / 8000;
  EXPECT_NEAR(simulation.solve_instant().viscosity, 1 + 2.5 * fraction, 1e-12);
}

TEST(Instant, NeedsRoomForThePairsAndImages) {
  const auto state = spheres_at({{1, 1, 1}}, {1});
  bad_input([&] { SuspensionSimulation(sheared_cube(4.9, 0), state, 1); });
  SuspensionSimulation(sheared_cube(5.1, 0), state, 1).solve_instant();
  auto setting = sheared_cube(10, 0);
  bad_input([&] { SuspensionSimulation(setting, spheres_at({{1, 1, 1}, {2, 2, 2}}, {1, 1}), 1); });
  // Any flow carries images along three periods, but not along two.
  setting.lubrication->gradient[1][0] = 1;
  SuspensionSimulation(setting, state, 1).solve_instant();
  std::get<BoxDomain>(setting.domain).periodic[2] = false;
  bad_input([&] { SuspensionSimulation(setting, state, 1); });
}

}  // namespace
}  // namespace viscontact::particles
