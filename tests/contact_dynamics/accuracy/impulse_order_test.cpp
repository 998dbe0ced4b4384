// gamma does not depend on the units; its error is of first order in the step for a curved motion,
// and none at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

TEST(Impulse, DoesNotDependOnTheUnits) {
  // Isostatic: three discs that rest on each other in a V of two planes.
  const auto gamma_in = [](double length, double mass, double time) {
    State state = no_particles(2);
    const double s = std::sqrt(0.5);
    add_particle(state, {0, std::sqrt(2.0) * length, 0}, length, mass);
    add_particle(state, {0, (std::sqrt(2.0) + 2) * length, 0}, length, 2 * mass);
    add_particle(state, {0, (std::sqrt(2.0) + 3.5) * length, 0}, 0.5 * length, 0.5 * mass);
    Setting setting;
    setting.planes = {plane_at_rest({}, {s, s, 0}), plane_at_rest({}, {-s, s, 0})};
    setting.gravity = {0, -length / (time * time), 0};
    setting.time_step = 0.01 * time;
    Simulation simulation(setting, state, 1);
    take_steps(simulation, 50);
    std::vector<double> gammas;
    const double unit = mass * length / time;
    for (const auto& [first, second] :
         {std::pair(-1, 0), std::pair(-2, 0), std::pair(0, 1), std::pair(1, 2)})
      gammas.push_back(pair_of(simulation.state(), first, second).gamma / unit);
    return gammas;
  };
  const auto expected = gamma_in(1, 1, 1);
  EXPECT_NEAR(expected[2], -2.5 * 0.5, 1e-9);
  for (const auto& [length, mass, time] :
       {std::tuple(1e-6, 1e-15, 1e-3), std::tuple(3e5, 7e9, 11.0), std::tuple(0.3, 1e-9, 1e4)}) {
    const auto gammas = gamma_in(length, mass, time);
    for (std::size_t k = 0; k < gammas.size(); ++k)
      EXPECT_NEAR(gammas[k] / expected[k], 1, 1e-9) << length << ' ' << k;
  }
}

TEST(Impulse, AtRestDoesNotDependOnTheStep) {
  // Two discs fall, land and rest: the floor has taken the weight times the time.
  for (const double h : {1e-2, 1e-3, 1e-4}) {
    Setting setting;
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    setting.gravity = {0, -1, 0};
    setting.time_step = h;
    State state = no_particles(2);
    add_particle(state, {0, 1.1, 0}, 1, 1);
    add_particle(state, {0, 3.3, 0}, 1, 1);
    Simulation simulation(setting, state, 1);
    run(simulation, 1);
    EXPECT_NEAR(pair_of(simulation.state(), -1, 0).gamma, -2, 1e-8) << h;
    EXPECT_NEAR(pair_of(simulation.state(), 0, 1).gamma, -1, 1e-8) << h;
  }
}

/// A disc slides down another one, so heavy that nothing moves it, from an angle of 0.3 with a
/// speed of 0.2: the film holds both together. The angle from the vertical obeys 2 theta'' = sin
/// theta, and the film's gamma is minus the integral of cos theta - 2 theta'^2. Returns gamma after
/// a time of 1.
double gamma_of_slide(double h) {
  State state = no_particles(2);
  const double angle = 0.3;
  add_particle(state, {}, 1, 1e12);
  add_particle(state, {2 * std::sin(angle), 2 * std::cos(angle), 0}, 1, 1,
               {0.2 * std::cos(angle), -0.2 * std::sin(angle), 0});
  Setting setting;
  setting.forces[1] = constant({0, -1, 0});
  setting.time_step = h;
  Simulation simulation(setting, state, 1);
  take_steps(simulation, static_cast<int>(std::lround(1 / h)));
  return pair_of(simulation.state(), 0, 1).gamma;
}

TEST(Impulse, OfACurvedMotionIsOfFirstOrderInTheStep) {
  // By Runge and Kutta's method of fourth order in steps of 1e-3.
  constexpr double kExact = -0.8544427644219761;
  double coarser = gamma_of_slide(1e-2) - kExact;
  for (const double h : {1e-3, 1e-4}) {
    const double error = gamma_of_slide(h) - kExact;
    // 10 for an error of first order, of which the second order is some hundredths.
    EXPECT_NEAR(coarser / error, 10, 0.5) << h << ": " << error;
    coarser = error;
  }
}

}  // namespace
}  // namespace viscontact::particles
