// Rolling, sliding, landing and spinning discs and spheres with Coulomb's friction, against the
// closed forms of docs/physics.md, section 5. Without a film the law is plain Coulomb's.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/state/particles.hpp"

namespace viscontact::particles {
namespace {

// Velocities are solved to 1e-12 of a gap over h = 0.01; the rest is rounding of numbers of about
// 1 in some hundred steps.
constexpr double kRounding = 1e-9;
constexpr double kGravity = 9.81;

Setting setting_of(double h, double friction, std::optional<double> gamma_min = 0.0) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = gamma_min;
  setting.laws.friction = FrictionLaw{friction};
  setting.solver.tolerance = 1e-12;
  return setting;
}

/// One particle of mass 2 and radius 0.5 that touches the plane y = 0 in the origin.
State on_floor(int dimension, const Vector& velocity = {}, double height = 0) {
  State state = no_particles(dimension);
  add_particle(state, {0, 0.5 + height, 0}, 0.5, 2, velocity);
  add_rotation(state.particles);
  return state;
}

/// Angular velocity about the axis z.
double spin(const State& state) {
  return state.particles.angular_velocities[state.particles.dimension == 3 ? 2 : 0];
}
void set_spin(State& state, double to) {
  state.particles.angular_velocities[state.particles.dimension == 3 ? 2 : 0] = to;
}

/// The floor y = 0 with gravity turned by `alpha`, so that the floor is an incline falling to +x.
Setting incline(double h, double friction, double alpha, std::optional<double> gamma_min = 0.0) {
  auto setting = setting_of(h, friction, gamma_min);
  setting.planes = {plane_at_rest({}, {0, 1, 0})};
  setting.gravity = {kGravity * std::sin(alpha), -kGravity * std::cos(alpha), 0};
  return setting;
}

class Friction : public ::testing::TestWithParam<int> {
 protected:
  /// I/(m r^2)
  double inertia() const { return GetParam() == 3 ? 0.4 : 0.5; }
};
INSTANTIATE_TEST_SUITE_P(Dimensions, Friction, ::testing::Values(2, 3));

TEST_P(Friction, RollsBelowTheThresholdAndSlidesAboveIt) {
  // tan(alpha) = mu_s (1 + m r^2/I): 3 mu_s for a disc, 7/2 mu_s for a sphere.
  const double mu = 0.2, threshold = mu * (1 + 1 / inertia());
  for (const double factor : {0.3, 1 - 1e-3, 1 + 1e-3, 2.0}) {
    SCOPED_TRACE(factor);
    const double alpha = std::atan(factor * threshold);
    Simulation simulation(incline(0.01, mu, alpha), on_floor(GetParam()), 1);
    const double end = 1;
    run(simulation, end, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    const auto& state = simulation.state();
    const double v = state.particles.velocity(0)[0], rim = -0.5 * spin(state);
    // Constant forces and torques: velocities have no error of the step.
    if (factor < 1) {
      EXPECT_NEAR(v, kGravity * std::sin(alpha) / (1 + inertia()) * end, kRounding);
      EXPECT_NEAR(rim, v, kRounding);
    } else {
      EXPECT_NEAR(v, kGravity * (std::sin(alpha) - mu * std::cos(alpha)) * end, kRounding);
      EXPECT_NEAR(rim, mu * kGravity * std::cos(alpha) / inertia() * end, kRounding);
      EXPECT_GT(v, rim);
    }
    EXPECT_NEAR(state.particles.velocity(0)[1], 0, kRounding);
  }
}

TEST_P(Friction, LandingWithoutBounceSticksOrSlides) {
  // v_t+ = v_t-/(1 + I/(m r^2)) if the contact sticks, else v_t- - mu_s |v_n|. No force acts.
  for (const double tangential : {0.5, 3.0}) {
    const double mu = 0.4, normal = 1.3;
    auto setting = setting_of(0.01, mu);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    Simulation simulation(setting, on_floor(GetParam(), {tangential, -normal, 0}, 0.1), 1);
    run(simulation, 0.5, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
    const double sticks = tangential / (1 + inertia()), slides = tangential - mu * normal;
    EXPECT_NEAR(simulation.state().particles.velocity(0)[0], std::max(sticks, slides), kRounding);
  }
}

TEST_P(Friction, ASpinningBodyThatIsDroppedSetsOff) {
  // v_t = min(mu_s |v_n|, r w0/(1 + m r^2/I)): r w0/3 for a disc.
  for (const double w0 : {1.0, 20.0}) {
    const double mu = 0.4, normal = 1.3;
    auto setting = setting_of(0.01, mu);
    setting.planes = {plane_at_rest({}, {0, 1, 0})};
    auto state = on_floor(GetParam(), {0, -normal, 0}, 0.1);
    set_spin(state, -w0);
    Simulation simulation(setting, state, 1);
    run(simulation, 0.5);
    const double sticks = 0.5 * w0 / (1 + 1 / inertia());
    EXPECT_NEAR(simulation.state().particles.velocity(0)[0], std::min(mu * normal, sticks),
                kRounding);
  }
}

TEST_P(Friction, SlipOnAFloorEndsWhenTheSurfaceRests) {
  // r w0/((1 + m r^2/I) mu_s g): r w0/(3 mu_s g) for a disc. Found to a step.
  const double mu = 0.3, w0 = 10, h = 1e-3;
  auto state = on_floor(GetParam());
  set_spin(state, -w0);
  Simulation simulation(incline(h, mu, 0), state, 1);
  double last_slip = 0;
  run(simulation, 1.5, [&](const StepReport& report) {
    const double slip =
        simulation.state().particles.velocity(0)[0] + 0.5 * spin(simulation.state());
    if (std::abs(slip) > 1e-9) last_slip = report.time;
  });
  EXPECT_NEAR(last_slip, 0.5 * w0 / ((1 + 1 / inertia()) * mu * kGravity), h);
}

TEST_P(Friction, IsThatOfItsLawInAnyStepWithTheDefaultTolerances) {
  // Sliding ends at the velocity v0/(1 + I/(m r^2)), which stays. With a film of the impulse
  // -gamma_min, friction begins at the time -gamma_min/(m g). In the steps of 1e-5 friction moves
  // nothing by more than a hundredth of the tolerance of gaps, also beside a much larger particle.
  // Friction may be wrong by 1e-4 of the weight, which changes v by 2e-5 and the rim by 5e-5.
  for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex})
    for (const double gamma_min : {0.0, -0.02})
      for (const double h : {1e-3, 1e-4, 1e-5}) {
        SCOPED_TRACE(testing::Message() << "h = " << h << ", gamma_min = " << gamma_min);
        auto setting = incline(h, 0.3, 0, gamma_min);
        setting.laws.friction->method = method;
        setting.solver = {};
        auto state = on_floor(GetParam(), {0.02, 0, 0});
        add_particle(state, {100, 50, 0}, 10, 1, {});
        add_rotation(state.particles);
        Simulation simulation(setting, state, 1);
        run(simulation, 0.02, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
        const auto& particles = simulation.state().particles;
        EXPECT_NEAR(particles.velocity(0)[0], 0.02 / (1 + inertia()), 1e-4);
        EXPECT_NEAR(-0.5 * spin(simulation.state()), 0.02 / (1 + inertia()), 1e-4);
      }
}

TEST_P(Friction, AFilmKeepsFrictionAwayUntilItIsUsedUp) {
  // No friction until t_g = -gamma_min/(m g cos(alpha)); sliding ends at
  // t_g (1 + tan(alpha)/((1 + m r^2/I) mu_s - tan(alpha))).
  const double mu = 0.3, alpha = 0.3, gamma_min = -4;
  const double t_g = -gamma_min / (2 * kGravity * std::cos(alpha));
  const double end = t_g * (1 + std::tan(alpha) / ((1 + 1 / inertia()) * mu - std::tan(alpha)));
  const double h = 1e-3;
  Simulation simulation(incline(h, mu, alpha, gamma_min), on_floor(GetParam()), 1);
  double began_to_turn = 0, last_slip = 0;
  run(simulation, 1, [&](const StepReport& report) {
    const double w = spin(simulation.state());
    if (began_to_turn == 0 && w != 0) began_to_turn = report.time;
    if (std::abs(simulation.state().particles.velocity(0)[0] + 0.5 * w) > 1e-9)
      last_slip = report.time;
  });
  // The step in which the film is used up has friction for the rest of its impulse, so that the
  // motion does not depend on the step; the times are found to a step.
  EXPECT_NEAR(began_to_turn, t_g, h);
  EXPECT_NEAR(last_slip, end, h);
}

TEST_P(Friction, ATurningOrMovingPlaneDragsWhatLiesOnIt) {
  // On a belt that moves along itself at 2 a body slips until it rolls: the impulse of friction
  // gives it v and r w = -v m r^2/I, and slip ends when v - r w reaches 2.
  auto setting = incline(0.01, 0.5, 0);
  setting.planes[0].velocity = constant({2, 0, 0});
  Simulation simulation(setting, on_floor(GetParam()), 1);
  run(simulation, 2);
  const double v = simulation.state().particles.velocity(0)[0];
  EXPECT_NEAR(v, 2 / (1 + 1 / inertia()), kRounding);
  EXPECT_NEAR(v + 0.5 * spin(simulation.state()), 2, kRounding);
}

TEST_P(Friction, TheConvexRelaxationLiftsSlidingContacts) {
  // After a step of sliding at v_t the gap is h mu_s |v_t|, physics.md (5.9).
  auto setting = incline(0.01, 0.3, 0);
  setting.laws.friction->method = FrictionMethod::kConvex;
  Simulation simulation(setting, on_floor(GetParam(), {5, 0, 0}), 1);
  simulation.step(1);
  const auto& p = simulation.state().particles;
  const double slip = p.velocity(0)[0] + 0.5 * spin(simulation.state());
  EXPECT_GT(slip, 1);
  EXPECT_NEAR(p.position(0)[1] - 0.5, 0.01 * 0.3 * slip, 1e-9);
}

TEST_P(Friction, CollisionsKeepMomentumAndAngularMomentum) {
  Random random(7);
  State state = random_cloud(
      GetParam(), 20, 6, [] { return 0.5; }, random);
  auto& p = state.particles;
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < static_cast<std::size_t>(GetParam()); ++d)
      p.velocities[k * static_cast<std::size_t>(GetParam()) + d] =
          -0.5 * p.position(k)[d] + random.uniform(-0.3, 0.3);
  add_rotation(p);
  for (auto& w : p.angular_velocities) w = random.uniform(-2, 2);
  const auto total = [](const State& s) {
    Vector sum = angular_momentum(s.particles);
    for (std::size_t k = 0; k < s.particles.count(); ++k)
      sum = sum +
            (s.particles.dimension == 3
                 ? s.particles.inertias[k] * point_of(s.particles.angular_velocities.data(), k, 3)
                 : Vector{0, 0, s.particles.inertias[k] * s.particles.angular_velocities[k]});
    return sum;
  };
  const auto before = total(state), momentum_before = momentum(p);
  auto setting = setting_of(0.01, 0.4);
  // Impulses are opposite whatever their errors are, so that the usual tolerances do.
  setting.solver = {};
  Simulation simulation(setting, state, 1);
  bool touched = false;
  run(simulation, 3, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time;
    touched |= report.contacts > 0;
  });
  EXPECT_TRUE(touched);
  // Impulses are opposite, and lever arms meet in one point: rounding of 300 steps.
  EXPECT_LT(norm(total(simulation.state()) - before), 1e-11);
  EXPECT_LT(norm(momentum(simulation.state().particles) - momentum_before), 1e-12);
}

TEST_P(Friction, FreeFlightKeepsTheSpin) {
  auto state = on_floor(GetParam(), {1, 2, 0}, 3);
  set_spin(state, 2);
  auto setting = setting_of(0.01, 0.4);
  setting.torques[0] = constant({0, 0, 0.3});
  Simulation simulation(setting, state, 1);
  run(simulation, 2);
  const double moment = inertia() * 2 * 0.25;
  EXPECT_NEAR(spin(simulation.state()), 2 + 2 * 0.3 / moment, kRounding);
  if (GetParam() == 2) return;
  double square = 0;
  for (const double x : simulation.state().particles.orientations) square += x * x;
  EXPECT_NEAR(square, 1, 1e-14);
}

}  // namespace
}  // namespace viscontact::particles
