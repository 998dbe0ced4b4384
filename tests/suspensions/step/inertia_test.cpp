// Spheres with inertia: free motion, the lecture's case, and the balance of energy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/common/failure.hpp"
#include "tests/oracles/inertial_motion.hpp"
#include "tests/suspensions/spheres.hpp"

namespace viscontact::particles {
namespace {

Setting with_inertia(double viscosity) {
  Setting setting;
  PairLubrication lubrication;
  lubrication.viscosity = viscosity;
  lubrication.inertia = true;
  lubrication.range = 100;
  setting.lubrication = lubrication;
  return setting;
}

void run_to(SuspensionSimulation& simulation, double end) {
  while (simulation.step(end).parts > 0) continue;
}

TEST(SphereWithInertia, IsSlowedDownByItsDrag) {
  // In the shear u = (2 y, 0, 0) the velocity relative to the flow along y is v_0 exp(-t/T), T =
  // m/(6 pi mu a), and x obeys x'' = (2 y - x')/T; the spin relative to the flow dies out with
  // 8 pi mu a^3/I.
  const double mass = 3, start = 0.5, radius = 1.5;
  const auto errors_with = [&](double h) {
    auto setting = with_inertia(0.1);
    setting.lubrication->gradient[0][1] = 2;
    setting.time_step = h;
    auto state = spheres_at({{0, 1, 0}}, {radius});
    state.particles.masses = {mass};
    state.particles.inertias = {2.0 / 5 * mass * radius * radius};
    state.particles.velocities = {2, start, 0};
    state.particles.angular_velocities = {0, 0, 4};
    SuspensionSimulation simulation(setting, state, 1);
    run_to(simulation, 2);
    const double time = mass / (0.6 * M_PI * radius), t = 2;
    const double turn = 0.8 * M_PI * std::pow(radius, 3) / state.particles.inertias[0];
    const auto& p = simulation.state().particles;
    const double y = 1 + start * time * (1 - std::exp(-t / time));
    // With c = x' - 2 y: c' = -c/T - 2 y', so that c = -2 v_0 t exp(-t/T).
    const double slip = -2 * start * t * std::exp(-t / time);
    return std::vector{p.position(0)[1] - y, p.velocity(0)[1] - start * std::exp(-t / time),
                       p.velocity(0)[0] - 2 * y - slip,
                       p.angular_velocities[2] + 1 - 5 * std::exp(-turn * t)};
  };
  const auto coarse = errors_with(0.1), fine = errors_with(0.05);
  // Steps contain the decay. The acceleration by the shear is of the second order.
  for (const std::size_t i : {0U, 1U, 3U}) EXPECT_NEAR(fine[i], 0, 1e-11) << i;
  EXPECT_LT(std::abs(fine[2]), 1e-3);
  EXPECT_NEAR(coarse[2] / fine[2], 4, 0.1);
}

TEST(SphereWithInertia, NeedsAMassAndARate) {
  auto setting = sheared_cube(8, 0);
  setting.time_step = 0.1;
  setting.lubrication->inertia = true;
  auto state = spheres_at({{1, 1, 1}}, {1});
  const auto start = [&] { SuspensionSimulation(setting, state, 1); };
  EXPECT_NO_THROW(start());
  setting.lubrication->stress = 1;
  EXPECT_EQ(bad_input(start).kind(), ErrorKind::kBadInput);
  setting.lubrication->stress.reset();
  state.particles.masses.clear();
  EXPECT_EQ(bad_input(start).kind(), ErrorKind::kBadInput);
}

/// Spheres after some steps of a shear with the rate 1, whose setting has `change` then.
template <class Change>
SuspensionSimulation continued(Setting setting, const State& start, const Change& change) {
  SuspensionSimulation first(setting, start, 1);
  for (int k = 0; k < 3; ++k) first.step(1);
  change(setting);
  return {setting, first.state(), 1};
}

TEST(SphereWithInertia, GoesOnInTheSameShearAlongPeriods) {
  auto setting = sheared_cube(8, 0);
  setting.time_step = 0.1;
  setting.lubrication->inertia = true;
  const auto start = spheres_at({{1, 1, 1}, {4, 4, 4}}, {1, 1});
  const auto with_rate = [](double rate) {
    return [=](Setting& of) { of.lubrication->gradient[0][1] = rate; };
  };
  EXPECT_NO_THROW(continued(setting, start, with_rate(1)));
  // The velocity of an image would differ from that of its sphere by another velocity than that of
  // the flow, also if only the new run has inertia.
  for (const double rate : {2.0, 0.0, -1.0})
    EXPECT_EQ(bad_input([&] { continued(setting, start, with_rate(rate)); }).kind(),
              ErrorKind::kBadInput);
  auto without = setting;
  without.lubrication->inertia = false;
  EXPECT_NO_THROW(continued(without, start, with_rate(2)));
  EXPECT_EQ(bad_input([&] {
              continued(without, start, [&](Setting& of) {
                of.lubrication->inertia = true;
                of.lubrication->gradient[0][1] = 2;
              });
            }).kind(),
            ErrorKind::kBadInput);
}

TEST(SphereWithInertia, KeepsItsVelocityIfTheShearChangesWithoutPeriods) {
  const double mass = 3, height = 2, rate = 3;
  auto setting = with_inertia(0.1);
  setting.lubrication->gradient[0][1] = 1;
  setting.time_step = 0.1;
  auto start = spheres_at({{0, height, 0}}, {1});
  start.particles.masses = {mass};
  start.particles.velocities = {height, 0, 0};
  auto simulation =
      continued(setting, start, [&](Setting& of) { of.lubrication->gradient[0][1] = rate; });
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.velocity(0)[0], height, 1e-12);
  const double t = 0.4;
  run_to(simulation, 0.3 + t);
  const double slip = (1 - rate) * height * std::exp(-0.6 * M_PI * t / mass);
  EXPECT_NEAR(p.velocity(0)[0], rate * height + slip, 1e-11);
}

/// The lecture's sphere and plane: m = 20, mu = 3, r = 1, pushed by 200 for the time 2 and then
/// pulled.
SuspensionSimulation lecture(double h) {
  auto setting = with_inertia(3);
  setting.planes.emplace_back().start = {{}, {0, 0, 1}};
  setting.forces[0] = {{{2, {0, 0, -200}}, {4, {0, 0, 200}}}};
  setting.time_step = h;
  auto state = spheres_at({{0, 0, 2}}, {1});
  state.particles.masses = {20};
  return {setting, state, 1};
}

double gap_of(const SuspensionSimulation& simulation) {
  return simulation.state().particles.position(0)[2] - 1;
}

TEST(SphereWithInertia, OfTheLectureHasItsLeastGap) {
  auto simulation = lecture(1e-3);
  double least = 1;
  while (simulation.step(4).parts > 0) {
    least = std::min(least, gap_of(simulation));
    // Up to rounding errors of the place, about 1.
    EXPECT_NEAR(simulation.rheology().smallest_gap, gap_of(simulation), 1e-15);
  }
  // With the exact drag (tests/reduced_model/cases.hpp). The time of the least gap is between two
  // steps, so that 5/2 (h/2)^2 d2q/dt2 = 2e-4 of it may be left.
  EXPECT_NEAR(least / 2.97845928e-3, 1, 2e-4);
}

TEST(SphereWithInertia, OfTheLectureIsOfTheSecondOrder) {
  InertialMotion exact(
      {20,
       1,
       0,
       exact_plane_resistance(3, 1),
       {{2, [](long double) { return -200.0L; }}, {4, [](long double) { return 200.0L; }}}});
  std::vector<SuspensionSimulation> runs;
  for (const double h : {8e-3, 4e-3, 2e-3, 1e-3}) runs.push_back(lecture(h));
  for (const double time : {0.4, 1.0, 2.0, 3.2}) {
    exact.advance(time);
    std::vector<double> errors;
    for (auto& run : runs) {
      run_to(run, time);
      errors.push_back(gap_of(run) / static_cast<double>(exact.gap()) - 1);
    }
    for (const double error : errors) EXPECT_NEAR(error, 0, 1e-4);
    // What steps and the table of the plane leave.
    EXPECT_NEAR(errors[3], 0, 2e-6) << time;
    if (time > 1) continue;  // the film remembers errors of either sign
    EXPECT_NEAR(errors[0] / errors[1], 4, 0.2);
    EXPECT_NEAR(errors[1] / errors[2], 4, 0.2);
  }
}

}  // namespace
}  // namespace viscontact::particles
