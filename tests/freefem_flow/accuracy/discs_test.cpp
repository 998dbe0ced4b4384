// Discs of radius 1 in a plane flow of viscosity 1, solved by FreeFEM, against exact velocities and
// forces.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/freefem_flow/accuracy/exact_flows.hpp"
#include "tests/freefem_flow/placed_flow.hpp"
#include "tests/oracles/discs/reference_discs.hpp"
#include "viscontact/particles/contact/film_law.hpp"

namespace viscontact::freefem_flow {
namespace {

// Bounds on errors are 2e-3 with 12 edges, 2e-4 with 24, 2e-5 with 48 for extrapolated velocities
// and gaps from 0.1, 1e-3 with 24 edges and a gap of 0.02.

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
      // The penalty changes nothing of how errors of the mesh fall.
      if (constraint == RigidConstraint::kPenalty && edges > 12) continue;
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
    if (constraint == RigidConstraint::kRigid) {
      EXPECT_GT(std::log2(errors[12] / errors[48]) / 2, 3);
    }
  }
}

/// A case of data/reference/discs.csv as a flow: the numbers of all discs, one disc after the
/// other.
struct Mobility {
  explicit Mobility(const std::string& name) {
    const auto found = reference_discs(VISCONTACT_SOURCE_FOLDER, name);
    size = found.problem.size;
    for (std::size_t k = 0; k < found.problem.discs.size(); ++k) {
      const auto& disc = found.problem.discs[k];
      discs.push_back({disc.centre.real(), disc.centre.imag(), disc.radius});
      forces.insert(forces.end(), {disc.force.real(), disc.force.imag(), disc.torque});
      const auto& velocity = found.answer.velocities[k];
      velocities.insert(velocities.end(),
                        {velocity.real(), velocity.imag(), found.answer.spins[k]});
    }
  }
  double size = 0;
  std::vector<Body> discs;
  std::vector<double> forces, velocities;
};

TEST(Discs, MoveAsExactWithEachConstraint) {
  for (const auto* name : {"near the wall, towards it", "two, gap 0.1, squeezed", "unequal"})
    for (const auto constraint : kConstraints) {
      // By penalty, one flow without symmetry is enough; force_errors_test.cpp drives the others.
      if (constraint == RigidConstraint::kPenalty && std::string(name) != "unequal") continue;
      SCOPED_TRACE(::testing::Message()
                   << name << (constraint == kConstraints[1] ? ", rigid" : ""));
      const Mobility exact(name);
      PlacedFlow flow(fluid_with(24, constraint), DiscDomain{{}, exact.size}, exact.discs);
      const auto of_one_mesh = flow.velocities(exact.forces);
      const auto estimated = flow.estimate(exact.forces);
      EXPECT_LT(error_of(estimated.velocities, exact.velocities), kBounds.at(24));
      EXPECT_LT(error_of(of_one_mesh, exact.velocities), 1.1 * estimated.of_velocities.of_one_mesh);
    }
}

TEST(Discs, InANarrowGapMoveAsExact) {
  const Mobility exact("two, gap 0.02, squeezed");
  for (const auto constraint : kConstraints) {
    PlacedFlow flow(fluid_with(24, constraint), DiscDomain{{}, exact.size}, exact.discs);
    EXPECT_LT(error_of(flow.estimate(exact.forces).velocities, exact.velocities), 1e-3);
  }
}

TEST(Disc, AsSmallAsFreeFemCanMeshHasAMobilityThatGrowsWithTheLogarithm) {
  // FreeFEM writes warnings where the edges grow from a small disc to a large domain. The
  // mobilities of small discs at one place differ by ln(ratio of radii)/(4 pi), but for
  // (radius/domain)^2 = 6e-6.
  const BoxDomain box = {{0, 0}, {4, 4}, {}};
  double difference = 0, error = 6e-6;
  for (const auto& [radius, sign] : {std::pair(4e-6, 1), std::pair(1e-2, -1)}) {
    PlacedFlow flow(fluid_with(8, RigidConstraint::kRigid), box, {{1.9, 1.7, radius}});
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

// Disc 0 approaches a wall or disc 1 at the velocity 1, at gaps from `gap` to 10 gap.
struct Approach {
  const char* name;
  particles::Domain domain;
  Body at_contact;  // disc 0 where the gap is 0
  double x, y;      // direction in which the gap opens
  std::vector<Body> others;
  double r_first;  // of FilmLaw::lowest_gamma
};

TEST(Disc, TheForceOfItsApproachAddsUpToGammaMin) {
  // gamma_min of (6.8) is minus the impulse of the film from D_c = 10 gap to 2 s = gap. The rest of
  // the container adds less than 0.5 %.
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<Approach> approaches = {
      {"wall", BoxDomain{{-8, 0}, {8, 16}, {}}, {0, 1}, 0, 1, {}, infinite},
      {"smaller disc", DiscDomain{{}, 8}, {-1, 0}, -1, 0, {{0.5, 0, 0.5}}, 0.5},
      {"round wall", DiscDomain{{}, 3}, {2, 0}, -1, 0, {}, -3}};
  for (const auto& [name, domain, at_contact, x, y, others, r_first] : approaches) {
    const double r_eff = lubrication::effective_radius(1, r_first);
    const double gap = 0.002 * r_eff;
    // Simpson's rule in ln q; R q is nearly q^(-1/2), so that its error is below 1e-4.
    constexpr std::array kWeights = {1, 4, 2, 4, 1};
    const double step = std::log(10.0) / 4;
    double impulse = 0;
    for (std::size_t i = 0; i < kWeights.size(); ++i) {
      const double q = gap * std::exp(static_cast<double>(i) * step);
      std::vector<Body> discs = {{at_contact.x + q * x, at_contact.y + q * y}};
      discs.insert(discs.end(), others.begin(), others.end());
      PlacedFlow::Driven driven = {{0, {-x, -y, 0}}};
      if (!others.empty()) driven[1] = {0, 0, 0};
      PlacedFlow flow(fluid_with(16, RigidConstraint::kRigid), domain, discs, driven);
      flow.velocities();
      const auto forces = flow.solver().quantities().fluid_forces;
      impulse += kWeights[i] * step / 3 * q * (forces[0] * x + forces[1] * y);
    }
    particles::FilmLaw law;
    law.viscosity = 1;
    law.roughness = gap / 2;
    law.shape = particles::FilmShape::kDiscs;
    law.begins_at = 10 * gap;
    const double gamma_min = law.lowest_gamma(1, r_first);
    EXPECT_GT(-impulse / gamma_min, 0.998) << name;
    EXPECT_LT(-impulse / gamma_min, 1.006) << name;
  }
}

TEST(Disc, MidwayInAChannelHasTheExactDragAndSpin) {
  // The exact channel is periodic, of 6 widths; this one ends 4 widths away, where the flow has
  // decayed to 1e-5. Both let no fluid pass in the mean.
  const double width = 10, half = 40;
  const double drag = 1 / Mobility("channel, force").velocities[0];
  const double torque = 1 / Mobility("channel, torque").velocities[2];
  const BoxDomain channel = {{-half, -width / 2}, {half, width / 2}, {}};
  for (const auto constraint : kConstraints) {
    PlacedFlow flow(fluid_with(24, constraint), channel, {{}}, {{0, {1, 0, 0}}});
    flow.velocities();
    EXPECT_NEAR(-flow.solver().quantities().fluid_forces[0], drag, 2e-3 * drag);
    PlacedFlow spun(fluid_with(24, constraint), channel, {{}}, {{0, {0, 0, 1}}});
    spun.velocities();
    EXPECT_NEAR(-spun.solver().quantities().fluid_forces[2], torque, 2e-3 * torque);
  }
}

TEST(Penalty, HasTheErrorOfTheExactLaw) {
  // The extrapolated error of the mesh, 1e-5, is within 5 % of the law. The ratio is 1 + 1/penalty.
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
  const std::vector<Body> discs = {{-1.05, 0}, {1.05, 0}};
  PlacedFlow flow(fluid_with(24), DiscDomain{{}, 6}, discs);
  const auto first = flow.velocities(forces);
  // MUMPS orders a system by random numbers if it has more than 5000 rows.
  EXPECT_GT(flow.solver().unknowns(), 5000);
  const auto estimated = flow.estimate(forces).velocities;
  flow.particles().positions[0] -= 0.5;
  flow.place();
  EXPECT_NE(flow.velocities(forces), first);
  flow.particles().positions[0] += 0.5;
  flow.place();
  EXPECT_EQ(flow.velocities(forces), first);
  EXPECT_EQ(flow.estimate(forces).velocities, estimated);
  PlacedFlow fresh(fluid_with(24), DiscDomain{{}, 6}, discs);
  EXPECT_EQ(fresh.velocities(forces), first);
}

TEST(LargeMesh, IsComparedWithACoarserOne) {
  const auto fluid = fluid_with(24);
  const DiscDomain domain = {{}, 6};
  const auto discs = particles_of({{-1.05, 0}, {1.05, 0}}, 2);
  const std::vector<double> angles(2), forces = {1, 0, 0, -1, 0, 0};
  SolverLimits limits;
  limits.most_unknowns_to_refine = 1000;
  FlowProcess flow(
      fluid, domain, shapes_of(discs), 2, solver_command(fluid, 2),
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
  const double error = error_of(velocities, Mobility("two, gap 0.1, squeezed").velocities);
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
