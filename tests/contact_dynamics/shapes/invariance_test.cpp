// Many ellipses, plates and discs without a fluid: balances of piles and collisions; invariances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/common/temporary_folder.hpp"
#include "tests/contact_dynamics/shapes/shapes.hpp"
#include "tests/particles/systems.hpp"
#include "viscontact/particle_runs/io/restart.hpp"
#include "viscontact/particles/steps/current_contacts.hpp"

namespace viscontact::particles {
namespace {

/// A scene in a box with friction: rows of ellipses, plates and discs that fall.
State falling(std::size_t rows, std::uint64_t seed) {
  Random random(seed);
  State state = no_particles(2);
  for (std::size_t k = 0; k < 4 * rows; ++k) {
    const Vector at = {0.6 + static_cast<double>(k % 4), 0.6 + 1.05 * static_cast<double>(k / 4)};
    const Shape shape = k % 3 == 0   ? Shape::ellipse(0.45, 0.2)
                        : k % 3 == 1 ? Shape::plate(0.45, 0.1)
                                     : Shape::disc(0.3);
    add_shape(state, shape, at, random.uniform(0, 3), shape.measure(),
              {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)});
  }
  return state;
}

Setting box_with_friction(double h) {
  auto setting = setting_of(h, 0.5);
  setting.domain = BoxDomain{{0, 0, 0}, {4.2, 30, 0}};
  setting.gravity = {0, -kGravity, 0};
  return setting;
}

TEST(Pile, ComesToRestAndItsForcesBalance) {
  const auto setting = box_with_friction(2e-3);
  Simulation simulation(setting, falling(6, 3), 1);
  double energy = energy_in_gravity(simulation.state().particles), gain = 0;
  run(simulation, 5, [&](const StepReport& report) {
    expect_converged(report);
    const double now = energy_in_gravity(simulation.state().particles);
    gain = std::max(gain, now - energy);
    energy = now;
  });
  const auto& p = simulation.state().particles;
  double weight = 0;
  for (const double mass : p.masses) weight += mass * kGravity;
  // Finite turns of flat sides.
  EXPECT_LT(gain, 1e-9 * energy);
  EXPECT_LT(energy_of_motion(p), 1e-12 * energy);
  // Half of the tolerance is left where it is, and half is the error of a step.
  EXPECT_LT(largest_overlap(setting, simulation.state()), setting.solver.tolerance);
  std::vector<Vector> forces(p.count());
  for (std::size_t k = 0; k < p.count(); ++k) forces[k][1] = -p.masses[k] * kGravity;
  for (const auto& contact : contacts_of(setting, simulation.state())) {
    const Vector force = contact.normal_force * contact.normal + contact.tangential_force;
    auto& on_second = forces[index_of(contact.second)];
    on_second = on_second + force;
    if (contact.first < 0) continue;
    auto& on_first = forces[index_of(contact.first)];
    on_first = on_first - force;
  }
  for (const auto& force : forces) EXPECT_LT(norm(force), 1e-6 * weight);
}

TEST(Collisions, KeepMomentumAndAngularMomentumAndLoseEnergy) {
  for (const double friction : {0.0, 0.4}) {
    SCOPED_TRACE(friction);
    auto state = falling(4, 5);
    auto& p = state.particles;
    // Towards the middle.
    for (std::size_t k = 0; k < p.count(); ++k)
      for (std::size_t d = 0; d < 2; ++d) p.velocities[2 * k + d] += 2.1 - p.positions[2 * k + d];
    for (auto& spin : p.angular_velocities) spin = 1;
    const Vector before = momentum(p);
    const double turning = angular_momentum_with_spin(p);
    double energy = energy_of_motion(p), gain = 0;
    Simulation simulation(setting_of(2e-3, friction), state, 1);
    std::size_t contacts = 0;
    run(simulation, 2, [&](const StepReport& report) {
      expect_converged(report);
      contacts += report.contacts;
      const double now = energy_of_motion(simulation.state().particles);
      gain = std::max(gain, now - energy);
      energy = now;
    });
    const auto& after = simulation.state().particles;
    EXPECT_LT(gain, 1e-6 * energy);
    EXPECT_GT(contacts, 1000U);
    EXPECT_LT(norm(momentum(after) - before), 1e-12);
    EXPECT_NEAR(angular_momentum_with_spin(after), turning, 1e-11);
  }
}

/// A scene with a setting in which contacts last: shapes that fall into a corner with friction.
struct Scene {
  State state = falling(2, 11);
  Setting setting = box_with_friction(5e-3);
  Scene() {
    setting.domain = {};
    setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({}, {1, 0, 0})};
    setting.gravity = {-2, -kGravity, 0};
    setting.laws.film.gamma_min = -0.01;
    setting.solver.tolerance = 1e-12;
  }
  Particles after(double end) const {
    Simulation simulation(setting, state, 1);
    run(simulation, end, expect_converged);
    EXPECT_GT(contacts_of(setting, simulation.state()).size(), 5U);
    return simulation.state().particles;
  }
};

// Rounding errors and residuals grow in the motion up to this time by less than a factor of 1e4.
constexpr double kEnd = 0.7, kSame = 1e-8;

/// Turned by `angle` about the origin or, if `is_mirrored`, first mirrored at the y axis.
Scene mapped(Scene scene, double angle, bool is_mirrored) {
  const double sign = is_mirrored ? -1 : 1;
  const auto map = [&](const Vector& x) -> Vector {
    const Vector y = {sign * x[0], x[1], 0};
    return displacement_at(y, {0, 0, angle}, y, 2);
  };
  auto& p = scene.state.particles;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector x = map(p.position(k)), v = map(p.velocity(k));
    std::copy_n(x.begin(), 2, &p.positions[2 * k]);
    std::copy_n(v.begin(), 2, &p.velocities[2 * k]);
    p.angles[k] = sign * p.angles[k] + angle;
    p.angular_velocities[k] *= sign;
  }
  scene.setting.gravity = map(scene.setting.gravity);
  for (auto& plane : scene.setting.planes)
    plane.start = {map(plane.start.point), map(plane.start.normal)};
  return scene;
}

TEST(Shapes, MoveInTheSameWaySeenFromAnotherSide) {
  const Scene scene;
  const auto straight = scene.after(kEnd);
  for (const bool is_mirrored : {false, true})
    for (const double angle : {0.0, std::numbers::pi / 6}) {
      SCOPED_TRACE(testing::Message() << is_mirrored << " " << angle);
      const auto other = mapped(scene, angle, is_mirrored).after(kEnd);
      Scene expected;
      expected.state.particles = straight;
      const auto map = mapped(expected, angle, is_mirrored).state.particles;
      for (std::size_t k = 0; k < other.count(); ++k) {
        EXPECT_LT(norm(other.position(k) - map.position(k)), kSame);
        EXPECT_NEAR(other.angles[k], map.angles[k], kSame);
      }
    }
}

TEST(Shapes, MoveInTheSameWayUnderOtherNames) {
  const Scene scene;
  const auto first = scene.after(kEnd);
  Scene renamed;
  renamed.state = no_particles(2);
  const auto& p = scene.state.particles;
  const std::size_t n = p.count();
  for (std::size_t k = n; k-- > 0;)
    add_shape(renamed.state, p.shapes[k], p.position(k), p.angles[k], p.masses[k], p.velocity(k),
              p.angular_velocities[k]);
  const auto last = renamed.after(kEnd);
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_LT(norm(first.position(k) - last.position(n - 1 - k)), kSame);
    EXPECT_NEAR(first.angles[k], last.angles[n - 1 - k], kSame);
  }
}

TEST(Shapes, MoveInTheSameWayInOtherUnits) {
  constexpr double kLength = 1024, kWeight = 0.125, kTime = 32;
  const Scene scene;
  Scene other;
  auto& p = other.state.particles;
  for (std::size_t k = 0; k < p.count(); ++k) {
    p.radii[k] *= kLength;
    p.shapes[k] = p.shapes[k].scaled(kLength);
    p.masses[k] *= kWeight;
    p.inertias[k] *= kWeight * kLength * kLength;
    p.angular_velocities[k] /= kTime;
  }
  for (auto& x : p.positions) x *= kLength;
  for (auto& v : p.velocities) v *= kLength / kTime;
  other.setting.gravity = kLength / (kTime * kTime) * other.setting.gravity;
  other.setting.time_step *= kTime;
  *other.setting.laws.film.gamma_min *= kWeight * kLength / kTime;
  const auto one = scene.after(kEnd), scaled = other.after(kTime * kEnd);
  for (std::size_t k = 0; k < p.count(); ++k) {
    EXPECT_LT(norm((1 / kLength) * scaled.position(k) - one.position(k)), kSame);
    EXPECT_NEAR(scaled.angles[k], one.angles[k], kSame);
  }
}

TEST(Shapes, ContinueFromARestartBitForBit) {
  const auto setting = box_with_friction(5e-3);
  Simulation whole(setting, falling(3, 4), 1);
  run(whole, 0.8);
  const TemporaryFolder folder;
  const auto saved = folder.file("restart.bin", write_restart(whole.state()));
  run(whole, 1);
  auto state = read_restart(saved);
  state.particles.shapes = whole.state().particles.shapes;
  Simulation continued(setting, state, 2);
  run(continued, 1);
  EXPECT_EQ(continued.state().particles.positions, whole.state().particles.positions);
  EXPECT_EQ(continued.state().particles.angles, whole.state().particles.angles);
  EXPECT_EQ(continued.state().pairs, whole.state().pairs);
  EXPECT_EQ(continued.state().walls, whole.state().walls);
}

// Semi-axes that differ by 1e-9 move all places by about as much, times the factor by which
// contacts multiply differences.
TEST(Shapes, ThatAreNearlyRoundMoveLikeDiscs) {
  for (const auto method : {FrictionMethod::kCoulomb, FrictionMethod::kConvex}) {
    Scene discs, ellipses;
    discs.setting.laws.friction->method = ellipses.setting.laws.friction->method = method;
    Random random(2);
    discs.state = no_particles(2);
    for (std::size_t k = 0; k < 8; ++k)
      add_shape(discs.state, Shape::disc(0.45),
                {0.6 + static_cast<double>(k % 4), 0.6 + 1.05 * static_cast<double>(k / 4)}, 0, 1,
                {random.uniform(-1, 1), random.uniform(-1, 1)});
    ellipses.state = discs.state;
    for (auto& shape : ellipses.state.particles.shapes) shape = Shape::ellipse(0.45, 0.45 + 1e-9);
    // With films the convex method takes its loads from the solution before, and a correction for
    // turns is one more solution: 1e-5 at the end.
    const double end = method == FrictionMethod::kConvex ? 0.4 : kEnd;
    const auto round = discs.after(end), nearly = ellipses.after(end);
    for (std::size_t k = 0; k < round.count(); ++k) {
      EXPECT_LT(norm(nearly.position(k) - round.position(k)), 1e-7);
      EXPECT_NEAR(nearly.angles[k], round.angles[k], 1e-7);
    }
  }
}

}  // namespace
}  // namespace viscontact::particles
