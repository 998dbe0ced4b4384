// What must not change the flow that FreeFEM computes: where the box of a period begins, and the
// unit of length. And that the estimate of the error is true on the lecture's mesh.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "tests/freefem_flow/accuracy/exact_flows.hpp"
#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/freefem_flow/process/solver_units.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::DiscDomain;
using particles::FluidMesh;
using particles::RigidConstraint;

double torque_of_a_spinning_disc(FluidMesh mesh, double x) {
  auto fluid = fluid_with(16);
  fluid.mesh = mesh;
  PlacedFlow flow(fluid, BoxDomain{{0, 0}, {6, 4}, {true, false}}, {{x, 2}}, {{0, {0, 0, 1}}});
  flow.velocities();
  return flow.solver().quantities().fluid_forces[2];
}

TEST(PeriodicBox, MayCutADisc) {
  const double fitted = torque_of_a_spinning_disc(FluidMesh::kFitted, 3);
  EXPECT_NEAR(torque_of_a_spinning_disc(FluidMesh::kFitted, 0.2), fitted, 1e-3 * -fitted);
  // The fixed mesh meets the disc in other places when the disc is moved.
  const double fixed = torque_of_a_spinning_disc(FluidMesh::kFixed, 3);
  EXPECT_NEAR(torque_of_a_spinning_disc(FluidMesh::kFixed, 0.2), fixed, 0.1 * -fixed);
}

TEST(PeriodicBox, OfTheFixedMeshMayCutAFreeDisc) {
  std::vector<double> spins;
  for (const double x : {3.0, 0.2}) {
    auto fluid = fluid_with(16);
    fluid.mesh = FluidMesh::kFixed;
    PlacedFlow flow(fluid, BoxDomain{{0, 0}, {6, 4}, {true, false}}, {{x, 2}});
    const auto motion = flow.velocities(std::vector{0.0, 0.0, 1.0});
    spins.push_back(motion[2]);
    // A force-free disc midway does not move.
    EXPECT_NEAR(motion[0], 0, 0.1 * motion[2]) << x;
  }
  EXPECT_NEAR(spins[1], spins[0], 0.1 * spins[0]);
}

TEST(Units, DoNotChangeTheVelocity) {
  // Water in mm, kg, s is 1e-6; 1e4 and 1e-5 are lengths in units that are too small or too large.
  for (const double viscosity : {1e-30, 1e-6, 1e30})
    for (const double unit : {1e-15, 1e-5, 1e4, 1e20}) {
      auto fluid = fluid_with(12);
      fluid.viscosity = viscosity;
      PlacedFlow flow(fluid, DiscDomain{{}, 4 * unit}, {{0, 0, unit}});
      const auto motion = flow.velocities({viscosity, 0, 0});
      EXPECT_NEAR(motion[0], concentric_mobility(4), 0.01 * concentric_mobility(4));
      const auto quantities = flow.solver().quantities();
      EXPECT_NEAR(quantities.fluid_forces[0], -viscosity, 1e-6 * viscosity);
      EXPECT_NEAR(quantities.dissipation, viscosity * motion[0], 1e-6 * viscosity * motion[0]);
    }
}

TEST(Units, DoNotChangeTheForceOnASphere) {
  // Drag over 6 pi mu r u in a closed cylinder; the exact value is not needed.
  std::vector<double> factors;
  for (const double unit : {1.0, 1e-6}) {
    auto fluid = fluid_with(12);
    fluid.viscosity = 1e-3;
    PlacedFlow flow(fluid, particles::CylinderDomain{5 * unit, 10 * unit}, {{0, 3 * unit, unit}},
                    {{0, {2 * unit, 0, 0}}});
    flow.velocities();
    factors.push_back(flow.solver().quantities().fluid_forces[0] / (unit * unit));
  }
  EXPECT_LT(factors[0], 0);
  EXPECT_NEAR(factors[1], factors[0], 1e-3 * -factors[0]);
}

TEST(Origin, OfASceneFarAwayDoesNotChangeTheFlow) {
  // Places relative to the domain are multiples of 1/16, so that they are exact in both scenes.
  constexpr double kFar = 1 << 27;
  struct Scene {
    std::array<bool, 3> periodic;
    double x, y;
  };
  for (const auto mesh : {FluidMesh::kFitted, FluidMesh::kFixed})
    for (const auto& scene : {Scene{{}, -kFar, kFar}, Scene{{true, false, false}, kFar, 0},
                              Scene{{true, true, false}, kFar, -kFar}}) {
      std::vector<std::vector<double>> answers;
      std::vector<particles::FlowField> fields;
      for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(scene.x, scene.y)}) {
        auto fluid = fluid_with(12);
        fluid.mesh = mesh;
        if (scene.periodic[0]) fluid.boundary = particles::LinearFlow{{0, 1, 0, 0}};
        if (!scene.periodic[1]) fluid.probes = {{"p", {x + 1, y}, {x + 1, y + 6}}};
        PlacedFlow flow(fluid, BoxDomain{{x, y}, {x + 8, y + 6}, scene.periodic},
                        {{x + 3, y + 2.5}, {x + 5.25, y + 3}});
        answers.push_back(flow.velocities({0, -1, 0, 0.5, 0, 0.25}));
        for (const auto& probe : flow.solver().quantities().probes)
          answers.back().insert(answers.back().end(), probe.begin(), probe.end());
        fields.push_back(flow.solver().flow());
        for (std::size_t i = 0; i < fields.back().x.size(); ++i) {
          fields.back().x[i] -= x;
          fields.back().y[i] -= y;
        }
      }
      EXPECT_EQ(answers[1], answers[0]);
      ASSERT_EQ(fields[1].x.size(), fields[0].x.size());
      EXPECT_EQ(fields[1].velocity_x, fields[0].velocity_x);
      for (std::size_t i = 0; i < fields[0].x.size(); ++i) {
        EXPECT_NEAR(fields[1].x[i], fields[0].x[i], 1e-7);
        EXPECT_NEAR(fields[1].y[i], fields[0].y[i], 1e-7);
      }
    }
}

TEST(Origin, OfWallsThatMoveWithALinearFlowIsInTheirVelocity) {
  auto fluid = fluid_with(12);
  fluid.boundary = particles::LinearFlow{{1, 2, 3, -1}};
  const BoxDomain box{{1e6, -1e7}, {1e6 + 8, -1e7 + 6}};
  const auto units = solver_units(fluid, box, std::vector{4.0});
  EXPECT_EQ(units.origin, (std::array{1e6, -1e7}));
  const auto& flow = std::get<particles::LinearFlow>(in_units(fluid, units).boundary);
  EXPECT_DOUBLE_EQ(flow.at_origin[0] * units.length, 1e6 - 2e7);
  EXPECT_DOUBLE_EQ(flow.at_origin[1] * units.length, 3e6 + 1e7);
  EXPECT_EQ(solver_units(fluid, BoxDomain{{-700, 500}, {-692, 506}}, std::vector{4.0}).origin,
            (std::array<double, 2>{}));
}

TEST(ShearedCell, MovesADiscWithTheShearAtItsPlace) {
  // Alone in its cell, a disc moves with the mean flow: docs/physics.md (6.3), centre of the box at
  // 3.
  for (const auto constraint : {RigidConstraint::kPenalty, RigidConstraint::kRigid})
    for (const double y : {3.0, 4.0, 5.5}) {
      auto fluid = fluid_with(12, constraint);
      fluid.boundary = particles::LinearFlow{{0, 1, 0, 0}};
      PlacedFlow flow(fluid, BoxDomain{{0, 0}, {8, 6}, {true, true}}, {{4, y}});
      const auto motion = flow.velocities();
      EXPECT_NEAR(motion[0], y - 3, 1e-3) << y;
      EXPECT_NEAR(motion[1], 0, 1e-3) << y;
    }
}

TEST(Estimate, DoesNotDependOnTheUnitOfLength) {
  std::vector<double> errors;
  for (const double unit : {1.0, 1e-3}) {
    PlacedFlow flow(fluid_with(12), DiscDomain{{}, 4 * unit},
                    {{-1.3 * unit, 0, unit}, {1.1 * unit, 0.3 * unit, unit}});
    // Torques, which turn the discs, have the unit of length twice in them.
    const auto found = flow.estimate(std::vector{1.0, 0.0, 5.0 * unit, 0.0, 1.0, -8.0 * unit});
    errors.push_back(found.of_velocities.best);
    errors.push_back(found.of_velocities.of_one_mesh);
  }
  // Units are not powers of 2, so that rounding errors differ, and the meshes a little.
  EXPECT_NEAR(errors[2], errors[0], 0.1 * errors[0]);
  EXPECT_NEAR(errors[3], errors[1], 0.1 * errors[1]);
}

TEST(Estimate, IsTrueOnTheFixedMesh) {
  for (const int edges : {12, 16}) {
    auto fluid = fluid_with(edges);
    fluid.mesh = FluidMesh::kFixed;
    PlacedFlow flow(fluid, DiscDomain{{}, 5}, {{}});
    const std::vector forces = {1.0, 0.0, 0.0};
    const double of_one_mesh = flow.velocities(forces)[0] / concentric_mobility(5) - 1;
    const auto found = flow.estimate(forces);
    const double error = found.velocities[0] / concentric_mobility(5) - 1;
    EXPECT_LT(std::abs(error), found.of_velocities.best) << edges;
    EXPECT_LT(std::abs(of_one_mesh), found.of_velocities.of_one_mesh) << edges;
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
