// Bodies of discs that overlap, in the fluid of FreeFEM: the fluid sees their union. Viscosity 1.
// Docs: fluid.md.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/particles/setting/chords.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::norm;
using particles::RigidConstraint;
using particles::Vector;

/// Free discs in the middle of a round wall of radius 4, which are one body if they are several.
struct InRoundWall {
  particles::Setting setting{};
  particles::State state{};

  explicit InRoundWall(const std::vector<Body>& discs, int edges = 16) {
    setting.domain = particles::DiscDomain{{0, 0}, 4};
    setting.fluid = fluid_with(edges, RigidConstraint::kRigid);
    setting.fluid->threshold_gap = 1e-3;
    setting.time_step = 1e-3;
    auto& p = state.particles;
    p = particles_of(discs, 2);
    p.masses.assign(discs.size(), 0);
    p.velocities.assign(2 * discs.size(), 0);
    p.angles.assign(discs.size(), 0);
    p.angular_velocities.assign(discs.size(), 0);
    p.inertias.assign(discs.size(), 0);
  }
  void join() {
    std::vector<std::int32_t> members(state.particles.count());
    std::iota(members.begin(), members.end(), 0);
    add_rigid_body(state.particles, {members});
    setting.fluid->cut_areas = cut_areas_of(*setting.fluid, state.particles);
  }
  /// The state after a step.
  particles::Particles after_step() const {
    particles::FluidSimulation simulation(
        setting, state,
        start_fluid_solver(*setting.fluid, setting.domain, shapes_of(state.particles), 2));
    EXPECT_TRUE(simulation.step(1).converged);
    return simulation.state().particles;
  }
};

// A row of discs of the radius 0.2 whose centres are 0.1 apart is a plate with notches of the depth
// 0.2 (1 - sqrt(15)/4) = 0.006.
TEST(OverlappingMembers, InARowMoveAsAPlate) {
  std::vector<Body> discs;
  for (int i = -6; i <= 6; ++i) discs.push_back({0.1 * i, 0, 0.2});
  InRoundWall row(discs);
  row.join();
  InRoundWall plate({{0, 0, 0.8}});
  plate.state.particles.shapes = {particles::Shape::plate(0.8, 0.2)};
  const auto velocities = [](InRoundWall& of, std::int32_t middle) {
    of.setting.forces[middle] = {{{1e300, {1, 1, 0}}}};
    of.setting.torques[middle] = {{{1e300, {0, 0, 1}}}};
    const auto p = of.after_step();
    const auto k = static_cast<std::size_t>(middle);
    return Vector{p.velocity(k)[0], p.velocity(k)[1], p.angular_velocities[k]};
  };
  const auto of_row = velocities(row, 6), of_plate = velocities(plate, 0);
  for (std::size_t c = 0; c < 3; ++c) {
    // The notches make the row thinner, and therefore faster.
    EXPECT_GT(of_row[c], of_plate[c]) << c;
    EXPECT_LT(of_row[c], 1.02 * of_plate[c]) << c;
  }
}

// A body with the mass of the fluid in its place stays where it is, without turning: buoyancy acts
// on the union, at the centre of its area.
TEST(OverlappingMembers, FloatInAFluidOfTheirDensity) {
  InRoundWall body({{-0.3, 0.2, 0.5}, {0.3, -0.1, 0.3}, {-0.9, 0.3, 0.2}});
  auto& p = body.state.particles;
  body.setting.fluid->density = 2;
  body.setting.gravity = {3, -10, 0};
  body.join();
  const auto areas = body.setting.fluid->cut_areas;
  ASSERT_EQ(areas.size(), 3U);
  p.bodies = {};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_GT(areas[k], 0) << k;
    p.masses[k] = 2 * body.setting.fluid->size_of(p.shape(k), k);
    p.inertias[k] = 0.01 * p.masses[k];
  }
  body.join();
  const auto after = body.after_step();
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(after.velocity(k)[0], 0, 1e-12);
    EXPECT_NEAR(after.velocity(k)[1], 0, 1e-12);
    EXPECT_NEAR(after.angular_velocities[k], 0, 1e-12);
  }
}

// Two plates of one body whose circles meet, but not the plates, are plates, by rigid motions and
// by penalty.
TEST(OverlappingMembers, AreNoPlatesWhoseCirclesMeet) {
  const auto velocity = [](RigidConstraint constraint) {
    InRoundWall body({{0, -0.5, 1}, {0, 0.5, 1}}, 12);
    body.state.particles.shapes.assign(2, particles::Shape::plate(1, 0.2));
    body.setting.fluid->constraint = constraint;
    body.join();
    EXPECT_TRUE(body.setting.fluid->cut_areas.empty());
    body.setting.forces[0] = {{{1e300, {1, 0, 0}}}};
    return body.after_step().velocity(0);
  };
  const Vector rigid = velocity(RigidConstraint::kRigid),
               penalty = velocity(RigidConstraint::kPenalty);
  for (std::size_t d = 0; d < 2; ++d) EXPECT_NEAR(penalty[d], rigid[d], 1e-2 * norm(rigid));
}

// The same body turned by an angle moves with the turned velocity, but for the error of its mesh,
// which is below 1e-4 with 24 edges and falls as the fourth power.
TEST(OverlappingMembers, AreTheSameTurned) {
  const auto velocity = [](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    std::vector<Body> discs;
    for (const auto& [x, y, r] : {Body{-0.4, 0, 0.5}, Body{0.3, 0.1, 0.4}})
      discs.push_back({c * x - s * y, s * x + c * y, r});
    InRoundWall body(discs, 16);
    body.join();
    body.setting.forces[0] = {{{1e300, {c, s, 0}}}};
    const auto p = body.after_step();
    const Vector v = p.velocity(0);
    return Vector{c * v[0] + s * v[1], c * v[1] - s * v[0], p.angular_velocities[0]};
  };
  const auto straight = velocity(0), turned = velocity(0.7);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(turned[c], straight[c], 5e-4 * straight[0]) << c;
}

}  // namespace
}  // namespace viscontact::freefem_flow
