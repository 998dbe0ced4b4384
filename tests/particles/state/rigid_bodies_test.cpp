// Rigid bodies of several particles: free flight, contact, and a body of one particle, which moves
// as the particle alone.
#include "viscontact/particles/state/rigid_bodies.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/particles/systems.hpp"
#include "viscontact/particles/domain/periods.hpp"

namespace viscontact::particles {
namespace {

constexpr double kGravity = 9.81;

Setting setting_of(double h, double friction = 0) {
  Setting setting;
  setting.time_step = h;
  setting.laws.film.gamma_min = 0;
  setting.laws.friction = FrictionLaw{friction};
  setting.solver.tolerance = 1e-10;
  return setting;
}

/// A body of three unequal particles that moves and turns.
State flying_body(int dimension) {
  State state = no_particles(dimension);
  add_particle(state, {0, 0, 0}, 0.5, 2, {1, 0.5, -0.2});
  add_particle(state, {0.8, 0.1, 0.2}, 0.4, 1, {1, 0.9, 0.3});
  add_particle(state, {0.1, 0.9, -0.7}, 0.3, 3, {0.2, 0.5, 0.1});
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{0, 1, 2}});
  return state;
}

double energy_of(const RigidBody& body) {
  return 0.5 * body.mass * dot(body.velocity, body.velocity) +
         0.5 * dot(body.angular_velocity, body.angular_momentum);
}

/// About the origin, with the spin of the particles.
Vector total_angular_momentum(const Particles& p) {
  Vector sum = angular_momentum(p);
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < 3; ++d) {
      if (p.dimension == 3) sum[d] += p.inertias[k] * p.angular_velocities[3 * k + d];
      if (p.dimension == 2 && d == 2) sum[d] += p.inertias[k] * p.angular_velocities[k];
    }
  return sum;
}

class RigidBodies : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, RigidBodies, ::testing::Values(2, 3));

TEST_P(RigidBodies, ABodyTakesOverTheMomentumOfItsMembers) {
  State state = no_particles(GetParam());
  add_particle(state, {0, 0, 0}, 0.5, 2, {1, 0.5, -0.2});
  add_particle(state, {0.8, 0.1, 0.2}, 0.4, 1, {1, 0.9, 0.3});
  add_rotation(state.particles);
  const Vector p = momentum(state.particles), l = total_angular_momentum(state.particles);
  add_rigid_body(state.particles, {{1, 0}});
  const Vector p_after = momentum(state.particles),
               l_after = total_angular_momentum(state.particles);
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(p_after[d], p[d], 1e-15 * 10);
    EXPECT_NEAR(l_after[d], l[d], 1e-15 * 10);
  }
}

TEST_P(RigidBodies, FreeFlightKeepsMomentumAngularMomentumAndShapeToRoundOff) {
  const int dimension = GetParam();
  Simulation simulation(setting_of(0.01), flying_body(dimension), 1);
  const auto first = simulation.state().particles;
  const auto& start = first.bodies.bodies[0];
  run(simulation, 5);
  const auto& p = simulation.state().particles;
  const auto& body = p.bodies.bodies[0];
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(body.velocity[d], start.velocity[d], 1e-13);
    EXPECT_NEAR(body.centre[d], start.centre[d] + 5 * start.velocity[d], 1e-12);
    EXPECT_EQ(body.angular_momentum[d], start.angular_momentum[d]);
  }
  for (std::int32_t i = 0; i < 3; ++i)
    for (std::int32_t j = 0; j < i; ++j)
      EXPECT_NEAR(norm(p.position(index_of(i)) - p.position(index_of(j))),
                  norm(first.position(index_of(i)) - first.position(index_of(j))), 1e-14 * 10);
  // The midpoint rule turns the body about an axis that is not exact: of second order in h.
  EXPECT_NEAR(energy_of(body), energy_of(start),
              (dimension == 3 ? 1e-4 : 1e-13) * energy_of(start));
}

TEST(RigidBodiesInSpace, ATumblingBodyTurnsWithSecondOrder) {
  std::vector<Vector> ends;
  for (const double h : {0.04, 0.02, 0.01, 0.0025}) {
    Simulation simulation(setting_of(h), flying_body(3), 1);
    run(simulation, 2);
    ends.push_back(simulation.state().particles.position(2));
  }
  const double coarse = norm(ends[0] - ends[3]), middle = norm(ends[1] - ends[3]),
               fine = norm(ends[2] - ends[3]);
  EXPECT_GT(coarse, 1e-6);  // a body that does not tumble would show nothing
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.2);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.2);
}

TEST_P(RigidBodies, ABodyOfOneParticleRollsAsTheParticle) {
  for (const double friction : {0.05, 0.5}) {
    std::vector<Particles> ends;
    for (const bool is_body : {false, true}) {
      auto setting = setting_of(0.01, friction);
      setting.planes = {plane_at_rest({}, {0, 1, 0})};
      setting.gravity = {kGravity * std::sin(0.4), -kGravity * std::cos(0.4), 0};
      State state = no_particles(GetParam());
      add_particle(state, {0, 0.7, 0}, 0.5, 2);
      add_rotation(state.particles);
      if (is_body) add_rigid_body(state.particles, {{0}});
      Simulation simulation(setting, state, 1);
      run(simulation, 1, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
      ends.push_back(simulation.state().particles);
    }
    for (std::size_t k = 0; k < ends[0].positions.size(); ++k) {
      EXPECT_NEAR(ends[1].positions[k], ends[0].positions[k], 1e-9);
      EXPECT_NEAR(ends[1].velocities[k], ends[0].velocities[k], 1e-8);
    }
    for (std::size_t k = 0; k < ends[0].angular_velocities.size(); ++k)
      EXPECT_NEAR(ends[1].angular_velocities[k], ends[0].angular_velocities[k], 1e-7);
  }
}

TEST_P(RigidBodies, CollisionsOfBodiesKeepMomentumAndAngularMomentum) {
  State state = flying_body(GetParam());
  // A second body and a particle in its way.
  add_particle(state, {3.0, 0.5, 0.1}, 0.5, 2, {-1, 0, 0});
  add_particle(state, {3.7, 0.6, 0}, 0.4, 1, {-1, 0, 0});
  add_particle(state, {2.0, 1.6, 0}, 0.4, 1, {0, -0.3, 0});
  add_rotation(state.particles);
  add_rigid_body(state.particles, {{3, 4}});
  const Vector p = momentum(state.particles), l = total_angular_momentum(state.particles);
  auto setting = setting_of(0.01, 0.4);
  Simulation simulation(setting, state, 1);
  std::size_t contacts = 0;
  run(simulation, 4, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged) << report.time;
    contacts += report.contacts;
  });
  EXPECT_GT(contacts, 3U);
  const auto& after = simulation.state().particles;
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(momentum(after)[d], p[d], 1e-8);
    // Impulses act on points that are where they were before the step, the angular momentum is
    // taken about places after it: of first order in h.
    EXPECT_NEAR(total_angular_momentum(after)[d], l[d], 0.02);
  }
}

TEST(RigidBodiesInACell, ABodyThatCrossesThePeriodKeepsItsShapeAndMeetsOthersThere) {
  // A rod of two discs flies through the side of the cell towards a disc behind it.
  State state = no_particles(2);
  add_particle(state, {8, 1, 0}, 0.5, 1, {2, 0, 0});
  add_particle(state, {9, 1, 0}, 0.5, 1, {2, 0, 0});
  add_particle(state, {3, 1, 0}, 0.5, 2, {});
  add_rotation(state.particles);
  Setting setting;
  setting.time_step = 0.01;
  setting.laws.film.gamma_min = 0;
  setting.domain = BoxDomain{.from = {0, 0}, .to = {10, 4}, .periodic = {true, false}};
  state.particles.cell = cell_of(setting.domain);
  add_rigid_body(state.particles, {{0, 1}});
  Simulation simulation(setting, state, 1);
  run(simulation, 4, [&](const StepReport& report) {
    EXPECT_TRUE(report.converged);
    const auto& p = simulation.state().particles;
    double apart = p.position(1)[0] - p.position(0)[0];
    apart -= 10 * std::round(apart / 10);
    EXPECT_NEAR(apart, 1, 1e-12) << report.time;
  });
  // Inelastic: both go on together with half the velocity.
  const auto& p = simulation.state().particles;
  EXPECT_NEAR(p.velocity(2)[0], 1, 1e-9);
  EXPECT_NEAR(p.velocity(0)[0], 1, 1e-9);
}

/// Centre of the body that discs of the given centres make in a cell of 8 x 6 that is periodic both
/// ways, and the vectors from it to them. The members are given in the order `order`.
struct Shape {
  Vector centre{};
  std::vector<Vector> offsets;
  double inertia = 0;
};
Shape shape_of(const std::vector<Vector>& centres, const std::vector<std::int32_t>& order,
               const Vector& from) {
  const BoxDomain box{
      .from = {from[0], from[1]}, .to = {from[0] + 8, from[1] + 6}, .periodic = {true, true}};
  State state = no_particles(2);
  std::vector<std::int32_t> members(order.size());
  for (std::size_t m = 0; m < order.size(); ++m) {
    Vector x = centres[index_of(order[m])];
    state.particles.cell = cell_of(box);
    for (const std::size_t d : {0U, 1U})
      x[d] -= periods_beyond(state.particles.cell, d, x[d]) * state.particles.cell.lengths[d];
    add_particle(state, x, 0.4, 1 + order[m]);
    members[m] = static_cast<std::int32_t>(m);
  }
  add_rotation(state.particles);
  EXPECT_FALSE(ambiguous_images(state.particles, members).has_value());
  add_rigid_body(state.particles, {members});
  const auto& body = state.particles.bodies.bodies[0];
  Shape shape{nearest_image(state.particles.cell, body.centre - centres[0]),
              std::vector<Vector>(order.size()), body.inertia[8]};
  for (std::size_t m = 0; m < order.size(); ++m)
    shape.offsets[index_of(order[m])] = body.offsets[m];
  return shape;
}

TEST(RigidBodiesInACell, AWideBodyDependsNeitherOnTheOrderNorOnWhereTheCellBegins) {
  // Seen from each of the three, the images that are nearest to it are others.
  const std::vector<Vector> centres = {{1, 0.3, 0}, {1.5, 2.6, 0}, {7.5, 4.75, 0}};
  std::vector<std::int32_t> order = {0, 1, 2};
  const auto expected = shape_of(centres, order, {});
  // The distances along y are 2.3, 2.15 and 1.55: the body ends at the first of them.
  EXPECT_NEAR(expected.offsets[0][1] - expected.offsets[1][1], 6.3 - 2.6, 1e-14);
  EXPECT_NEAR(expected.offsets[2][1] - expected.offsets[1][1], 4.75 - 2.6, 1e-14);
  EXPECT_NEAR(expected.offsets[2][0] - expected.offsets[0][0], -1.5, 1e-14);
  do
    for (const double x : {-3.0, 0.0, 1.2})
      for (const double y : {-5.0, 0.0, 0.4, 3.0}) {
        const auto shape = shape_of(centres, order, {x, y});
        EXPECT_NEAR(norm(shape.centre - expected.centre), 0, 1e-13);
        EXPECT_NEAR(shape.inertia, expected.inertia, 1e-12);
        for (std::size_t m = 0; m < 3; ++m)
          EXPECT_NEAR(norm(shape.offsets[m] - expected.offsets[m]), 0, 1e-13);
      }
  while (std::ranges::next_permutation(order).found);
}

TEST(RigidBodiesInACell, TwoDiscsHalfAPeriodApartDoNotDetermineTheirImages) {
  State state = no_particles(2);
  add_particle(state, {1, 1, 0}, 0.5, 1, {});
  add_particle(state, {1, 4.0000000001, 0}, 0.5, 1, {});
  EXPECT_FALSE(ambiguous_images(state.particles, {0, 1}).has_value());  // not periodic
  state.particles.cell = cell_of(BoxDomain{.from = {0, 0}, .to = {8, 6}, .periodic = {true, true}});
  const auto ambiguous = ambiguous_images(state.particles, {0, 1});
  ASSERT_TRUE(ambiguous.has_value());
  EXPECT_EQ(ambiguous->axis, 1U);
  EXPECT_NEAR(ambiguous->distance, 3, 1e-9);
  EXPECT_FALSE(ambiguous_images(state.particles, {0}).has_value());
}

TEST_P(RigidBodies, ABoxOfBodiesWithoutFrictionDoesNotDependOnTheirOrder) {
  // Loads in a packing are not unique. Sweeps chose them by the order of the contacts, so that
  // films differed, and positions by 6e-5.
  constexpr int kBodies = 20, kInARow = 4;
  for (const double gamma_min : {-0.5, 0.0}) {
    SCOPED_TRACE(gamma_min);
    auto setting = setting_of(0.02);
    setting.gravity = {0, -1, 0};
    setting.laws.film.gamma_min = gamma_min;
    setting.solver.tolerance = 1e-6;
    setting.planes = {plane_at_rest({}, {0, 1, 0}), plane_at_rest({-1, 0, 0}, {1, 0, 0}),
                      plane_at_rest({2.6 * kInARow + 1, 0, 0}, {-1, 0, 0})};
    const auto fallen = [&](bool is_reversed) {
      State state = no_particles(GetParam());
      for (int n = 0; n < kBodies; ++n) {
        const int k = is_reversed ? kBodies - 1 - n : n;
        const Vector at{1 + 2.6 * (k % kInARow), 1.8 + 2.6 * (k / kInARow), 0.1 * (k % 3)};
        add_particle(state, at, 0.5, 1);
        add_particle(state, at + 0.9 * Vector{std::cos(k), std::sin(k), 0}, 0.5, 1);
      }
      add_rotation(state.particles);
      for (std::int32_t n = 0; n < kBodies; ++n)
        add_rigid_body(state.particles, {{2 * n, 2 * n + 1}});
      Simulation simulation(setting, state, 1);
      run(simulation, 6, [](const StepReport& report) { EXPECT_TRUE(report.converged); });
      return simulation.state().particles;
    };
    const auto plain = fallen(false), reversed = fallen(true);
    for (std::size_t n = 0; n < kBodies; ++n)
      EXPECT_LT(norm(plain.position(2 * n) - reversed.position(2 * (kBodies - 1 - n))), 1e-10);
  }
}

TEST(RigidBodiesInSpace, ACubeOfEightSpheresThatIsThrownComesToRestOnAFace) {
  State state = no_particles(3);
  std::vector<std::int32_t> members;
  for (int n = 0; n < 8; ++n) {
    members.push_back(n);
    // Turned, so that it lands on a corner.
    const double x = (n & 1) - 0.5, y = ((n >> 1) & 1) - 0.5, z = ((n >> 2) & 1) - 0.5;
    const double c = std::cos(0.6), s = std::sin(0.6);
    const double x1 = c * x - s * y, y1 = s * x + c * y;
    add_particle(state, {c * x1 - s * z, y1, 2 + s * x1 + c * z}, 0.5, 1, {1, 0.3, 0});
  }
  add_rotation(state.particles);
  add_rigid_body(state.particles, {members});
  auto setting = setting_of(0.01, 0.5);
  setting.solver.tolerance = 1e-8;
  setting.gravity = {0, 0, -kGravity};
  setting.planes = {plane_at_rest({}, {0, 0, 1})};
  Simulation simulation(setting, state, 1);
  run(simulation, 8,
      [](const StepReport& report) { EXPECT_TRUE(report.converged) << report.time; });
  const auto& p = simulation.state().particles;
  std::vector<double> heights;
  for (std::size_t k = 0; k < 8; ++k) heights.push_back(p.position(k)[2]);
  std::ranges::sort(heights);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(heights[k], 0.5, 1e-6);
  for (std::size_t k = 4; k < 8; ++k) EXPECT_NEAR(heights[k], 1.5, 1e-6);
  for (const double v : p.velocities) EXPECT_NEAR(v, 0, 1e-5);
}

}  // namespace
}  // namespace viscontact::particles
