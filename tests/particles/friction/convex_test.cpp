// The convex relaxation of friction, docs/physics.md (5.9): one collision against the minimiser of
// its problem in closed form, and packings in which every step must converge.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <optional>

#include "tests/particles/systems.hpp"

namespace viscontact::particles {
namespace {

/// Lengths, masses and times of a case are multiplied by these.
struct Units {
  double length = 1, mass = 1, time = 1;
};

Setting convex_setting(double h, double mu_s, double gamma_min = 0) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = gamma_min;
  setting.laws.friction = FrictionLaw{mu_s, FrictionMethod::kConvex};
  return setting;
}

/// Two discs or spheres of mass 1 and radius 0.5; the second one flies at the first one and spins.
State two_particles(int dimension, const Units& in) {
  State state = no_particles(dimension);
  add_particle(state, {}, 0.5 * in.length, in.mass, {});
  add_particle(state, in.length * Vector{0.3, 1.6, 0}, 0.5 * in.length, in.mass,
               in.length / in.time * Vector{0.2, -1, 0});
  add_rotation(state.particles);
  auto& spins = state.particles.angular_velocities;
  spins[dimension == 3 ? 5 : 1] = 3 / in.time;
  return state;
}

double spin(const State& state, std::size_t k) {
  return state.particles.angular_velocities[state.particles.dimension == 3 ? 3 * k + 2 : k];
}

/// Normal and tangential impulse of a contact.
struct Impulses {
  double normal = 0, tangential = 0;
};

/// The impulses of the next step. A contact takes part if it had an impulse in the step before
/// (`touched`), or if its gap would close without it. Its impulses minimise w_n p_n^2/2 + g p_n +
/// w_t p_t^2/2 + v p_t over |p_t| <= mu_s p_n, where g and v are the gap and the slip without them.
/// The minimum is where both become 0 if that is allowed. Otherwise it is on the surface of the
/// cone, p_t = -+ mu_s p_n.
Impulses closed_form(const State& state, double h, double mu_s, bool touched) {
  const auto& p = state.particles;
  const Vector apart = p.position(1) - p.position(0);
  const Vector normal = (1 / norm(apart)) * apart;
  const Vector tangent{-normal[1], normal[0], 0};
  const Vector relative = p.velocity(1) - p.velocity(0);
  const double mass = p.masses[0], inertia = p.inertias[0], arm = norm(apart) / 2;
  const double gap = norm(apart) - p.radii[0] - p.radii[1] + h * dot(normal, relative);
  const double slip = h * (dot(tangent, relative) - arm * (spin(state, 0) + spin(state, 1)));
  if (gap >= 0 && !touched) return {};
  const double w_n = 2 * h / mass, w_t = 2 * h * (1 / mass + arm * arm / inertia);
  const Impulses sticking{-gap / w_n, -slip / w_t};
  if (std::abs(sticking.tangential) <= mu_s * sticking.normal) return sticking;
  const double load = (mu_s * std::abs(slip) - gap) / (w_n + mu_s * mu_s * w_t);
  if (load <= 0) return {};
  return {load, -std::copysign(mu_s * load, slip)};
}

class ConvexFriction : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, ConvexFriction, ::testing::Values(2, 3));

TEST_P(ConvexFriction, ACollisionHasTheImpulsesOfTheClosedForm) {
  // A fixed point with the slip of the step before converges only if mu_s^2 w_t/w_n < 1, that is
  // mu_s < 0.577 for discs and 0.535 for spheres.
  for (const double mu_s : {0.05, 0.5, 0.6, 2.0}) {
    SCOPED_TRACE(mu_s);
    const double h = 0.01;
    Simulation simulation(convex_setting(h, mu_s), two_particles(GetParam(), {}), 1);
    bool collided = false, touched = false;
    for (int step = 0; step < 100; ++step) {
      const State before = simulation.state();
      const auto expected = closed_form(before, h, mu_s, touched);
      const auto report = simulation.step(1);
      EXPECT_TRUE(report.converged) << step;
      EXPECT_LE(report.iterations, 200) << step;
      const Vector apart = before.particles.position(1) - before.particles.position(0);
      const Vector normal = (1 / norm(apart)) * apart;
      const Vector given = before.particles.masses[1] * (simulation.state().particles.velocity(1) -
                                                         before.particles.velocity(1));
      // Gaps are solved to impulse_tolerance, 1e-10, of the impulses at work, which are about 1.
      // Slips are solved to tolerance/2 mean radii, which is 2.5e-7/w_t = 5e-6 of the impulse.
      EXPECT_NEAR(dot(normal, given), expected.normal, 1e-5) << step;
      EXPECT_NEAR(dot({-normal[1], normal[0], 0}, given), expected.tangential, 1e-5) << step;
      touched = expected.normal > 0;
      collided |= expected.normal > 0.1;
    }
    EXPECT_TRUE(collided);
  }
}

TEST_P(ConvexFriction, ACollisionIsTheSameInAllUnits) {
  const double h = 0.01, mu_s = 0.6;
  const auto end_of = [&](const Units& in) {
    Simulation simulation(convex_setting(h * in.time, mu_s), two_particles(GetParam(), in), 1);
    for (int step = 0; step < 100; ++step) EXPECT_TRUE(simulation.step(in.time).converged);
    return simulation.state();
  };
  const State plain = end_of({});
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const auto decades = [&] { return std::pow(10.0, random.uniform(-5, 5)); };
    const Units in{decades(), decades(), decades()};
    const State scaled = end_of(in);
    const Vector apart =
        (1 / in.length) * scaled.particles.position(1) - plain.particles.position(1);
    // Rounding of 100 steps; the iterations are the same but for it.
    EXPECT_LT(norm(apart), 1e-11);
    EXPECT_NEAR(spin(scaled, 1) * in.time, spin(plain, 1), 1e-11);
  }
}

TEST_P(ConvexFriction, EveryStepOfABoxOfFortyParticlesConverges) {
  for (const double gamma_min : {0.0, -0.2})
    for (const double mu_s : {0.3, 0.6, 1.2}) {
      SCOPED_TRACE(gamma_min);
      SCOPED_TRACE(mu_s);
      Random random(5);
      const double half = GetParam() == 3 ? 2.5 : 4.5;
      State state = random_cloud(
          GetParam(), 40, half - 0.6, [] { return 0.5; }, random);
      auto& p = state.particles;
      add_rotation(p);
      for (auto& w : p.angular_velocities) w = random.uniform(-3, 3);
      auto setting = convex_setting(0.01, mu_s, gamma_min);
      setting.gravity = {0, -1, 0};
      for (std::size_t d = 0; d < static_cast<std::size_t>(GetParam()); ++d)
        for (const double side : {-1.0, 1.0}) {
          Vector point{}, normal{};
          point[d] = -side * half;
          normal[d] = side;
          setting.planes.push_back(plane_at_rest(point, normal));
        }
      Simulation simulation(setting, state, 1);
      std::size_t most = 0;
      run(simulation, 3, [&](const StepReport& report) {
        EXPECT_TRUE(report.converged) << report.time;
        most = std::max(most, static_cast<std::size_t>(report.contacts));
      });
      EXPECT_GT(most, 30U);  // the particles lie on each other
    }
}

}  // namespace
}  // namespace viscontact::particles
