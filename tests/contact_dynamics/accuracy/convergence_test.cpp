// Orders of convergence in the time step.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// log of the ratio of errors over log of the ratio of steps.
double order(double coarse, double fine, double ratio) {
  return std::log(coarse / fine) / std::log(ratio);
}

class Convergence : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Convergence, ::testing::Values(2, 3));

/// Largest errors of q and gamma in the lecture's limit case (physics.md, section 4): q = 1 - t^2
/// to t = 1, 0 to t = 4, then (t - 4)^2; gamma = -2t, 2t - 8.
std::array<double, 2> limit_case_errors(int dimension, double h) {
  Setting setting;
  setting.time_step = h;
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.forces[0] = {{{2, {0, -2, 0}}, {6, {0, 2, 0}}}};
  setting.solver.tolerance = 1e-14;
  State state = no_particles(dimension);
  add_particle(state, {0, 2, 0}, 1, 1);
  Simulation simulation(setting, state, 1);
  std::array<double, 2> errors{};
  run(simulation, 6, [&](const StepReport& report) {
    const double t = report.time;
    const double q = t < 1 ? 1 - t * t : t < 4 ? 0 : (t - 4) * (t - 4);
    const double gamma = t < 1 || t > 4 ? 0 : t <= 2 ? -2 * t : 2 * t - 8;
    const double height = simulation.state().particles.position(0)[1] - 1;
    errors[0] = std::max(errors[0], std::abs(height - q));
    // Within the two steps of the impact gamma is on its way from 0 to -2.
    if (std::abs(t - 1) > 2 * h)
      errors[1] = std::max(errors[1], std::abs(pair_of(simulation.state(), -1, 0).gamma - gamma));
  });
  return errors;
}

TEST_P(Convergence, InTheLimitCaseIsOfFirstOrder) {
  const auto coarse = limit_case_errors(GetParam(), 1e-2),
             fine = limit_case_errors(GetParam(), 1e-3);
  // C h (1 + O(h)): 2 h after the flight of 2.
  EXPECT_NEAR(order(coarse[0], fine[0], 10), 1, 0.02);
  EXPECT_LT(fine[0], 6e-3);
  // What the film has taken is exact, m u + gamma = int f, but for what the solver leaves: gaps of
  // 1e-14 over h/m.
  EXPECT_LT(coarse[1], 3e-11);
  EXPECT_LT(fine[1], 3e-11);
}

/// Two of masses 1 and 2, touching at t = 0, pushed together by 2 cos t until pi/2 and pulled apart
/// after: gamma = -2 sin t is 0 at pi, then the gap is 2 (1 + cos t) (1 + 1/2).
struct Smooth {
  double gap_error;        ///< at t = 5
  double corrected_error;  ///< of the gap less h u/2
  double gamma_error;      ///< largest
  double release_error;    ///< of the release time, as the velocity at t = 5 tells it
};

Smooth smooth_errors(int dimension, double h) {
  Setting setting;
  setting.time_step = h;
  setting.solver.tolerance = 1e-14;
  // Means of -2 cos over pieces that divide the steps.
  constexpr double kPiece = 1.0 / 1024;
  for (int n = 0; n < 5 * 1024 + 1; ++n) {
    const double push = 2 * (std::sin((n + 1) * kPiece) - std::sin(n * kPiece)) / kPiece;
    setting.forces[0].pieces.push_back({(n + 1) * kPiece, {push, 0, 0}});
    setting.forces[1].pieces.push_back({(n + 1) * kPiece, {-push, 0, 0}});
  }
  State state = no_particles(dimension);
  add_particle(state, {-1, 0, 0}, 1, 1);
  add_particle(state, {0.5, 0, 0}, 0.5, 2);
  Simulation simulation(setting, state, 1);
  Smooth errors{};
  run(simulation, 5, [&](const StepReport& report) {
    const double gamma = std::min(0.0, -2 * std::sin(report.time));
    if (report.time < 3.2)
      errors.gamma_error =
          std::max(errors.gamma_error, std::abs(pair_of(simulation.state(), 0, 1).gamma - gamma));
  });
  const double gap = 1.5 * 2 * (1 + std::cos(5.0));
  const auto& p = simulation.state().particles;
  const double velocity = p.velocity(1)[0] - p.velocity(0)[0];
  errors.gap_error = std::abs(pair_gap(simulation.state(), 0, 1) - gap);
  errors.corrected_error = std::abs(pair_gap(simulation.state(), 0, 1) - h * velocity / 2 - gap);
  errors.release_error = std::abs(velocity - 1.5 * -2 * std::sin(5.0));
  return errors;
}

TEST_P(Convergence, OfASmoothlyPulledPairIsOfFirstOrderAndTheReleaseExact) {
  const auto coarse = smooth_errors(GetParam(), 1.0 / 32),
             fine = smooth_errors(GetParam(), 1.0 / 256);
  RecordProperty("gap", std::to_string(fine.gap_error));
  // h u/2 (1 + O(h)): the scheme moves with the velocity of the step's end.
  EXPECT_NEAR(order(coarse.gap_error, fine.gap_error, 8), 1, 0.05);
  // The rest is of second order, the release within its step included (its share of the step is not
  // the same for both).
  EXPECT_GT(order(coarse.corrected_error, fine.corrected_error, 8), 1.8);
  // Impulses are exact, released ones too.
  for (const auto& errors : {coarse, fine}) {
    EXPECT_LT(errors.gamma_error, 1e-11);
    EXPECT_LT(errors.release_error, 1e-11);
  }
}

}  // namespace
}  // namespace viscontact::particles
