// Discs in the plane, solved by FreeFEM, against exact velocities and forces. Viscosity 1, radius 1.
// Bounds on errors: 2e-3 with 12 edges, 2e-4 with 24, 2e-5 with 48 for extrapolated velocities and
// gaps from 0.1, 1e-3 with 24 edges and a gap of 0.02.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/freefem_flow/accuracy/exact_flows.hpp"
#include "tests/freefem_flow/placed_flow.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::DiscDomain;
using particles::FluidMesh;
using particles::RigidConstraint;
using std::numbers::pi;

const std::map<int, double> kBounds = {{12, 2e-3}, {24, 2e-4}, {48, 2e-5}};
constexpr std::array kConstraints = {RigidConstraint::kPenalty, RigidConstraint::kRigid};

/// Largest difference relative to the largest expected number.
double error_of(const std::vector<double>& values, const std::vector<double>& expected) {
  double error = 0, largest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    error = std::max(error, std::abs(values.at(i) - expected[i]));
    largest = std::max(largest, std::abs(expected[i]));
  }
  return error / largest;
}

TEST(OneDisc, AtTheCentreMovesAsExactAndTheErrorFallsAsTheFourthPower) {
  for (const auto constraint : kConstraints) {
    std::map<int, double> errors;
    for (const auto& [edges, bound] : kBounds) {
      SCOPED_TRACE(::testing::Message() << edges << " edges");
      PlacedFlow flow(fluid_with(edges, constraint), DiscDomain{{2, -1}, 5}, {{2, -1}});
      const std::vector<double> forces = {1, 0, 0.5};
      const std::vector<double> exact = {concentric_mobility(5), 0,
                                         0.5 * concentric_rotational_mobility(5)};
      errors[edges] = error_of(flow.velocities(forces), exact);
      const auto estimated = flow.estimate(forces);
      EXPECT_LT(error_of(estimated.velocities, exact), bound);
      EXPECT_LT(error_of(estimated.velocities, exact), estimated.of_velocities.best);
      EXPECT_LT(errors[edges], 1.1 * estimated.of_velocities.of_one_mesh);
      EXPECT_LT(estimated.of_velocities.of_one_mesh, 2 * errors[edges]);
    }
    // The order scatters about 4, because each mesh is made anew; straight edges would give 2.
    EXPECT_GT(std::log2(errors[12] / errors[48]) / 2, 3);
  }
}

TEST(Discs, MoveAsExactWithEachConstraint) {
  for (const auto& [name, container, discs, forces, velocities] : kMobilities)
    for (const auto constraint : kConstraints) {
      SCOPED_TRACE(::testing::Message()
                   << name << (constraint == kConstraints[1] ? ", rigid" : ""));
      PlacedFlow flow(fluid_with(24, constraint), DiscDomain{{}, container}, discs);
      const auto of_one_mesh = flow.velocities(forces);
      const auto estimated = flow.estimate(forces);
      EXPECT_LT(error_of(estimated.velocities, velocities), kBounds.at(24));
      EXPECT_LT(error_of(of_one_mesh, velocities), 1.1 * estimated.of_velocities.of_one_mesh);
    }
}

TEST(Discs, InANarrowGapMoveAsOnAFineMesh) {
  const double gap = 0.02, x = 1 + gap / 2;
  const std::vector<double> forces = {1, 0, 0, -1, 0, 0};
  // With 48 edges and rigid motions, extrapolated; 96 edges differ by 1e-6.
  const std::vector<double> fine = {2.8975274e-4, 0, 0, -2.8975274e-4, 0, 0};
  for (const auto constraint : kConstraints) {
    PlacedFlow flow(fluid_with(24, constraint), DiscDomain{{}, 6}, {{-x, 0}, {x, 0}});
    EXPECT_LT(error_of(flow.estimate(forces).velocities, fine), 1e-3);
  }
}

TEST(Disc, AsSmallAsFreeFemCanMeshHasAMobilityThatGrowsWithTheLogarithm) {
  // FreeFEM writes warnings where the edges grow from a small disc to a large domain. The mobilities
  // of small discs at one place differ by ln(ratio of radii)/(4 pi), but for (radius/domain)^2 = 6e-6.
  const BoxDomain box = {{0, 0}, {4, 4}, {}};
  double difference = 0, error = 6e-6;
  for (const auto& [radius, sign] : {std::pair(4e-6, 1), std::pair(1e-2, -1)}) {
    PlacedFlow flow(fluid_with(12, RigidConstraint::kRigid), box, {{1.9, 1.7, radius}});
    const auto found = flow.estimate({0, 1, 0});
    EXPECT_LT(found.of_velocities.best, 1e-3);
    difference += sign * found.velocities[1];
    error += found.of_velocities.best * found.velocities[1];
  }
  EXPECT_NEAR(difference, std::log(1e-2 / 4e-6) / (4 * pi), error);
}

TEST(Disc, NearAWideWallHasTheDragOfAPlane) {
  // The other sides of the box, 40 radii away, change the drag towards the plane by much less than
  // that along it.
  const double distance = 1.2;
  PlacedFlow flow(fluid_with(48, RigidConstraint::kRigid), BoxDomain{{-40, 0}, {40, 80}, {}},
                  {{0, distance}}, {{0, {0, -1, 0}}});
  flow.velocities();
  const auto forces = flow.solver().quantities().fluid_forces;
  EXPECT_NEAR(forces[1] / drag_towards_plane(distance), 1, 2e-3);
  EXPECT_NEAR(forces[0], 0, 1e-2);
}

TEST(Disc, MidwayInAChannelHasTheExactDragAndSpin) {
  // docs/physics.md section 6, width H, k = 2/H = 0.2, no net flux; the channel ends 4 H away, where
  // the flow has decayed to 1e-5.
  const double width = 10, half = 40;
  const BoxDomain channel = {{-half, -width / 2}, {half, width / 2}, {}};
  for (const auto constraint : kConstraints) {
    PlacedFlow flow(fluid_with(24, constraint), channel, {{}}, {{0, {1, 0, 0}}});
    flow.velocities();
    EXPECT_NEAR(-flow.solver().quantities().fluid_forces[0], 16.532547, 2e-3 * 16.532547);
    PlacedFlow spun(fluid_with(24, constraint), channel, {{}}, {{0, {0, 0, 1}}});
    spun.velocities();
    EXPECT_NEAR(-spun.solver().quantities().fluid_forces[2] / (4 * pi), 1.031969, 2e-3);
  }
}

TEST(Penalty, HasTheErrorOfTheExactLaw) {
  // The extrapolated error of the mesh, 1e-5, is within 5 % of the law. lambda = 1 + 1/(epsilon mu).
  EXPECT_NEAR(penalty_law(5, 101), 6.085e-3, 1e-6);  // as docs/physics.md section 6 prints it
  for (const double penalty : {1e-2, 1e-3}) {
    const double law = penalty_law(5, 1 + 1 / penalty);
    auto fluid = fluid_with(24);
    fluid.penalty = penalty;
    PlacedFlow soft(fluid, DiscDomain{{}, 5}, {{}});
    const auto estimated = soft.estimate(std::vector{1.0, 0.0, 0.0});
    const double error = estimated.velocities[0] / concentric_mobility(5) - 1;
    EXPECT_NEAR(error, law, 0.05 * law) << penalty;
    // The estimate is made on one mesh, whose triangles within the disc are large.
    EXPECT_NEAR(estimated.of_velocities.of_penalty, law, 0.2 * law) << penalty;
    EXPECT_LT(error, estimated.of_velocities.best) << penalty;
  }
}

TEST(Penalty, GivesTheMotionsOfRigidBodies) {
  const std::vector<Body> discs = {{-1.5, 0.2, 1}, {1, 0, 0.7}, {0, 2, 0.5}};
  const std::vector<double> forces = {1, 0, 0, 0, -1, 0.5, 0.3, 0.2, -0.1};
  PlacedFlow soft(fluid_with(12), DiscDomain{{}, 5}, discs);
  PlacedFlow rigid(fluid_with(12, RigidConstraint::kRigid), DiscDomain{{}, 5}, discs);
  EXPECT_LT(error_of(soft.estimate(forces).velocities, rigid.estimate(forces).velocities),
            kBounds.at(12));
}

TEST(FixedMesh, ApproachesTheExactMobilitySlowly) {
  for (const auto constraint : kConstraints) {
    auto fluid = fluid_with(24, constraint);
    fluid.mesh = FluidMesh::kFixed;
    PlacedFlow flow(fluid, DiscDomain{{}, 5}, {{0.1, 0.2}});
    const auto velocities = flow.velocities({1, 0, 0});
    EXPECT_NEAR(velocities[0] / concentric_mobility(5), 1, 0.2);  // first order, here 12 %
    EXPECT_GT(std::abs(velocities[0] / concentric_mobility(5) - 1), 1e-3);
  }
}

TEST(Placement, GivesTheSameBitsWhateverCameBefore) {
  // A run that continues after an interrupt begins with a placement in the middle.
  const std::vector<double> forces = {1, 0, 0, -1, 0, 0};
  for (const int edges : {12, 24}) {
    const std::vector<Body> discs = {{-1.05, 0}, {1.05, 0}};
    PlacedFlow flow(fluid_with(edges), DiscDomain{{}, 6}, discs);
    const auto first = flow.velocities(forces);
    // MUMPS orders a system by random numbers if it has more than 5000 rows.
    EXPECT_EQ(flow.solver().unknowns() > 5000, edges == 24);
    const auto estimated = flow.estimate(forces).velocities;
    flow.particles().positions[0] -= 0.5;
    flow.place();
    EXPECT_NE(flow.velocities(forces), first);
    flow.particles().positions[0] += 0.5;
    flow.place();
    EXPECT_EQ(flow.velocities(forces), first);
    EXPECT_EQ(flow.estimate(forces).velocities, estimated);
    PlacedFlow fresh(fluid_with(edges), DiscDomain{{}, 6}, discs);
    EXPECT_EQ(fresh.velocities(forces), first);
  }
}

TEST(LargeMesh, IsComparedWithACoarserOne) {
  const auto fluid = fluid_with(24);
  const DiscDomain domain = {{}, 6};
  const auto discs = particles_of({{-1.05, 0}, {1.05, 0}}, 2);
  const std::vector<double> angles(2), forces = {1, 0, 0, -1, 0, 0};
  SolverLimits limits;
  limits.most_unknowns_to_refine = 1000;
  FlowProcess flow(
      fluid, domain, discs.radii, 2, solver_command(fluid, 2),
      [&](const particles::FluidParticles& placed, double coarsening) {
        return mesh_boundary(fluid, domain, placed, coarsening);
      },
      limits);
  flow.place({&discs, angles, {}, {}});
  const auto unknowns = flow.unknowns();
  const auto velocities = flow.velocities(forces, true);
  const auto dissipation = flow.quantities().dissipation;
  const auto estimated = particles::estimate_flow(flow, forces, discs, fluid);
  // The same mesh, whose unknowns MUMPS orders with other random numbers.
  constexpr double kRounding = 1e-7;
  EXPECT_LT(error_of(estimated.velocities, velocities), kRounding);
  EXPECT_EQ(estimated.of_velocities.best, estimated.of_velocities.of_one_mesh);
  const double error = error_of(velocities, kMobilities[2].velocities);
  EXPECT_GT(estimated.of_velocities.best, error);
  EXPECT_LT(estimated.of_velocities.best, 30 * error);
  // The flow afterwards is that on the mesh of the placement.
  EXPECT_EQ(flow.unknowns(), unknowns);
  EXPECT_NEAR(estimated.quantities.dissipation, dissipation, kRounding * dissipation);
  flow.flow();
  EXPECT_NEAR(flow.quantities().dissipation, dissipation, kRounding * dissipation);
  EXPECT_GT(flow.peak_memory_mebibytes(), 10);
}

}  // namespace
}  // namespace viscontact::freefem_flow
