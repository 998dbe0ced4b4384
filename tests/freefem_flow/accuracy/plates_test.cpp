// Plates with round ends in Stokes flow, and flows and pressures through lines across a channel,
// solved by FreeFEM (docs/fluid.md). Viscosity 1.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::Fluid;
using particles::FluidMesh;
using particles::RigidConstraint;
using particles::Shape;

Fluid fluid_of(int edges) {
  Fluid fluid;
  fluid.viscosity = 1;
  fluid.edges_per_particle = edges;
  fluid.constraint = RigidConstraint::kRigid;
  return fluid;
}

/// Particles at their places, and the solver around them.
struct Placed {
  particles::Particles bodies;
  std::vector<double> angles;
  std::unique_ptr<particles::FluidSolver> solver;

  Placed(const Fluid& fluid, const particles::Domain& domain, std::vector<double> positions,
         std::vector<Shape> shapes, std::vector<double> at_angles)
      : angles(std::move(at_angles)) {
    bodies.dimension = 2;
    bodies.positions = std::move(positions);
    bodies.shapes = std::move(shapes);
    for (const auto& shape : bodies.shapes) bodies.radii.push_back(shape.bounding_radius());
    solver = start_fluid_solver(fluid, domain, bodies.shapes, 2);
    solver->place({&bodies, angles, {}, {}});
  }
};

/// The velocities of a plate of the half length 1 in the middle of a round wall of radius 4.
std::vector<double> velocities(const Fluid& fluid, double end_radius, double angle,
                               const std::vector<double>& forces) {
  return Placed(fluid, particles::DiscDomain{{0, 0}, 4}, {0, 0}, {Shape::plate(1, end_radius)},
                {angle})
      .solver->velocities(forces, true);
}

// Hardly longer than thick, it moves as a disc of the same size: a change of the outline by 1 % of
// the radius at the ends changes velocities by less.
TEST(Plate, NearlyWithoutSidesMovesAsADisc) {
  const std::vector<double> forces = {1, 0.5, 0.3};
  const auto plate = velocities(fluid_of(16), 0.99, 0.4, forces);
  const auto disc =
      Placed(fluid_of(16), particles::DiscDomain{{0, 0}, 4}, {0, 0}, {Shape::disc(1)}, {0})
          .solver->velocities(forces, true);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(plate[c], disc[c], 0.02 * std::abs(disc[c]));
}

TEST(Plate, IsTheSameTurnedByPenaltyAndOnAFixedMesh) {
  const std::vector<double> along = {std::cos(0.7), std::sin(0.7), 0.5};
  const auto flat = velocities(fluid_of(16), 0.2, 0, {1, 0, 0.5});
  const auto turned = velocities(fluid_of(16), 0.2, 0.7, along);
  EXPECT_NEAR(std::hypot(turned[0], turned[1]), flat[0], 1e-3 * flat[0]);
  EXPECT_NEAR(turned[1], std::tan(0.7) * turned[0], 1e-3 * flat[0]);
  EXPECT_NEAR(turned[2], flat[2], 1e-3 * flat[2]);
  auto fluid = fluid_of(16);
  fluid.constraint = RigidConstraint::kPenalty;
  const auto penalty = velocities(fluid, 0.2, 0.7, along);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(penalty[c], turned[c], 1e-3 * flat[0]);
  // The fixed mesh errs by as much as with discs of the radius of the ends.
  fluid.mesh = FluidMesh::kFixed;
  fluid.edges_per_particle = 12;
  const auto fixed = velocities(fluid, 0.2, 0.7, along);
  EXPECT_NEAR(fixed[0], turned[0], 0.25 * turned[0]);
  // It moves more easily along itself than across.
  EXPECT_GT(flat[0], 1.05 * velocities(fluid_of(16), 0.2, 0, {0, 1, 0})[1]);
}

// Its ends are curved: the error falls faster than that of straight edges, to which the corners
// between ends and sides, where the curvature jumps, come near.
TEST(Plate, HasCurvedEnds) {
  const auto speed = [](int edges) { return velocities(fluid_of(edges), 0.3, 0.3, {1, 0, 0})[0]; };
  const double coarse = speed(8), middle = speed(16), fine = speed(32);
  EXPECT_GT(std::abs(coarse - middle) / std::abs(middle - fine), 5);
}

/// A channel of the height 2 and the length 5 with probes across it.
Fluid probed(int edges) {
  auto fluid = fluid_of(edges);
  fluid.probes = {{"in", {0, 0}, {0, 2}},
                  {"first", {1.3, 0}, {1.3, 2}},
                  {"slanted", {3, 0}, {3.6, 2}},
                  {"back", {4.5, 2}, {4.5, 0}},
                  {"out", {5, 0}, {5, 2}}};
  return fluid;
}

particles::Domain channel(bool is_periodic) {
  return particles::BoxDomain{{0, 0}, {5, 2}, {is_periodic, false}};
}

/// A side through which the fluid flows with this largest velocity.
particles::WallVelocity parabolic(double largest) {
  return {particles::WallVelocity::Kind::kParabolic, {largest, 0}};
}

// The parabola with the largest speed 1.5 carries 2/3 1.5 2 = 2, with the pressure gradient -8 mu
// 1.5/2^2 = -3. P2 elements contain it, so that all are exact to rounding.
TEST(Probes, MeasurePoiseuilleFlowExactly) {
  auto fluid = probed(12);
  particles::SideVelocities sides;
  sides[0] = parabolic(1.5);
  sides[1] = parabolic(-1.5);
  fluid.boundary = sides;
  Placed placed(fluid, channel(false), {}, {}, {});
  placed.solver->velocities(std::vector<double>{}, true);
  const auto probes = placed.solver->quantities().probes;
  ASSERT_EQ(probes.size(), 5U);
  for (const std::size_t k : {0U, 1U, 2U, 4U}) EXPECT_NEAR(probes[k][0], 2, 1e-9) << k;
  EXPECT_NEAR(probes[3][0], -2, 1e-9);
  EXPECT_NEAR(probes[1][1] - probes[3][1], 3 * (4.5 - 1.3), 1e-7);
  EXPECT_NEAR(probes[1][1] - probes[2][1], 3 * (3.3 - 1.3), 1e-7);
}

// Beside a disc that is held and one that moves the flow is not exact, but what flows in flows out.
TEST(Probes, WhatFlowsInFlowsOutBesideParticles) {
  auto fluid = probed(12);
  particles::SideVelocities sides;
  sides[0] = parabolic(1.5);
  sides[1].kind = particles::WallVelocity::Kind::kOpen;
  fluid.boundary = sides;
  Placed placed(fluid, channel(false), {2.1, 0.8}, {Shape::disc(0.3)}, {0});
  placed.solver->velocities(std::vector<double>{0.2, 0.1, 0}, true);
  const auto probes = placed.solver->quantities().probes;
  EXPECT_NEAR(probes[0][0], 2, 1e-9);
  for (const std::size_t k : {1U, 2U, 4U}) EXPECT_NEAR(probes[k][0], probes[0][0], 1e-9) << k;
  // The pressure falls along the channel.
  EXPECT_GT(probes[0][1], probes[1][1] + 3);
  EXPECT_GT(probes[1][1], probes[2][1] + 3);
}

// The lines are those of the box, wherever the mesh of a period has them.
TEST(Probes, MeasureAcrossAPeriod) {
  auto fluid = probed(10);
  fluid.boundary = particles::SideVelocities{};
  Placed placed(fluid, channel(true), {2.2, 0.7, 0.1, 1.3}, {Shape::disc(0.3), Shape::disc(0.3)},
                {0, 0});
  placed.solver->velocities(std::vector<double>{1, 0, 0, 0, 0, 0}, true);
  const auto probes = placed.solver->quantities().probes;
  EXPECT_GT(probes[1][0], 1e-3);
  EXPECT_NEAR(probes[2][0], probes[1][0], 1e-9);
  EXPECT_NEAR(probes[3][0], -probes[1][0], 1e-9);
}

}  // namespace
}  // namespace viscontact::freefem_flow
