// Balances of particles in a box with friction: all forces that change the momentum are listed, a
// body that friction locks between its contacts gains no energy, and bodies in a turning drum do.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

/// A box of this width on a floor, without a lid, in which gravity is 1.
Setting box_of_width(double width, int dimension, double h, double mu_s, double gamma_min,
                     FrictionMethod method) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = gamma_min;
  setting.laws.friction = FrictionLaw{mu_s, method};
  const auto down = static_cast<std::size_t>(dimension - 1);
  Vector normal{};
  normal[down] = 1;
  setting.gravity = -1.0 * normal;
  setting.planes = {plane_at_rest({}, normal)};
  for (std::size_t d = 0; d < down; ++d) {
    Vector side{};
    side[d] = 1;
    setting.planes.push_back(plane_at_rest({}, side));
    setting.planes.push_back(plane_at_rest(width * side, -1.0 * side));
  }
  return setting;
}

class Balance : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, Balance, ::testing::Values(2, 3));

// With given loads a contact may have friction in a step in which it bears no normal force.
TEST_P(Balance, MomentumChangesByTheListedForces) {
  const int dimension = GetParam();
  constexpr double kStep = 0.05, kWidth = 4;  // of the cloud, 1 from all sides
  int without_normal_force = 0;
  for (const auto method : {FrictionMethod::kConvex, FrictionMethod::kCoulomb})
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      Random random(seed);
      const auto setting = box_of_width(kWidth + 2, dimension, kStep, 0.7, -0.3, method);
      auto state = random_cloud(
          dimension, 3, kWidth, [] { return 0.9; }, random);
      auto& p = state.particles;
      for (std::size_t k = 0; k < p.count(); ++k) {
        for (std::size_t d = 0; d < 3; ++d)
          p.positions[3 * k + d] += d < 2 || dimension == 3 ? 1 : 0;
        p.masses[k] = 1;
      }
      add_rotation(p);
      Simulation simulation(setting, std::move(state), 1);
      auto before = momentum(simulation.state().particles);
      run(simulation, 5, [&](const StepReport& report) {
        const auto& now = simulation.state();
        Vector impulse = (kStep * static_cast<double>(now.particles.count())) * setting.gravity;
        double size = norm(impulse);
        for (const auto& contact : contacts_of(setting, now)) {
          without_normal_force +=
              contact.normal_force == 0 && norm(contact.tangential_force) > 1e-3 ? 1 : 0;
          if (contact.first >= 0) continue;
          const Vector force = contact.normal_force * contact.normal + contact.tangential_force;
          impulse = impulse + kStep * force;
          size += kStep * norm(force);
        }
        const auto after = momentum(now.particles);
        // 100 rounding errors of the impulses and of the momenta.
        EXPECT_LE(norm(after - before - impulse), 2e-14 * (size + norm(before)))
            << "seed " << seed << ", t = " << report.time;
        before = after;
      });
    }
  EXPECT_GT(without_normal_force, 0);
}

// With mu_s = 2, friction locks a body of two spheres between the floor and a wall, and the body
// turns about the line through both contacts. Forces that would give the correction for its turn
// are a thousand times its weight and add energy.
TEST(LockedBody, GainsNoEnergy) {
  int given = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const auto setting = box_of_width(1.8, 3, 0.05, 2, 0, FrictionMethod::kConvex);
    State state = no_particles(3);
    const Vector middle{0.9, 0.9, 1.2}, half = 0.45 * random.direction(3),
                                        velocity = 0.3 * random.direction(3);
    add_particle(state, middle - half, 0.38, 0.16, velocity);
    add_particle(state, middle + half, 0.3, 0.16, velocity);
    add_rotation(state.particles);
    add_rigid_body(state.particles, {{0, 1}});
    const auto energy = [&](const State& now) {
      const auto& body = now.particles.bodies.bodies[0];
      return 0.5 * body.mass * dot(body.velocity, body.velocity) +
             0.5 * dot(body.angular_velocity, body.angular_momentum) + body.mass * body.centre[2];
    };
    const double most = 0.32 * 1.2;  // of its weight times its first height
    Simulation simulation(setting, std::move(state), 1);
    double before = energy(simulation.state());
    run(simulation, 7.5, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged) << "seed " << seed << ", t = " << report.time;
      given += report.has_given_loads ? 1 : 0;
      const double after = energy(simulation.state());
      // A turn is of first order in the step, as the energy that the scheme may add.
      EXPECT_LE(after - before, 0.01 * most) << "seed " << seed << ", t = " << report.time;
      before = after;
    });
  }
  EXPECT_GT(given, 0);
}

// The walls do work, so that turns give a step more energy than its motion without corrections has.
TEST(TurningDrum, BodiesWithCoulombsLawConvergeInEveryStep) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    Random random(seed);
    Setting setting;
    setting.time_step = 0.02;
    setting.laws.film.gamma_min = 0;
    setting.laws.friction = FrictionLaw{0.1};
    setting.gravity = {0, -1, 0};
    for (const Vector& inward : {Vector{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}) {
      auto plane = plane_at_rest(-2.0 * inward, inward);
      plane.angular_velocity = {0, 0, 3};
      setting.planes.push_back(plane);
    }
    State state = no_particles(2);
    for (const Vector& middle : {Vector{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}}) {
      const Vector half = 0.45 * random.direction(2);
      add_particle(state, middle - half, random.uniform(0.33, 0.4), 1);
      add_particle(state, middle + half, random.uniform(0.33, 0.4), 1);
    }
    add_rotation(state.particles);
    for (std::int32_t b = 0; b < 4; ++b) add_rigid_body(state.particles, {{2 * b, 2 * b + 1}});
    Simulation simulation(setting, std::move(state), 1);
    run(simulation, 4, [&](const StepReport& report) {
      EXPECT_TRUE(report.converged) << "seed " << seed << ", t = " << report.time;
    });
  }
}

}  // namespace
}  // namespace viscontact::particles
