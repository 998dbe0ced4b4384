// Flows whose walls move or let fluid through, periodic cells, and spheres in a cylinder, solved by
// FreeFEM, against exact values. Viscosity 1.
#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "tests/oracles/discs/reference_discs.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::DiscDomain;
using particles::FluidMesh;
using particles::LinearFlow;
using particles::RigidConstraint;
using particles::SideVelocities;
using particles::WallVelocity;
using std::numbers::pi;

constexpr std::array kConstraints = {RigidConstraint::kPenalty, RigidConstraint::kRigid};
// The penalty 1e-7 makes the matrix so stiff that rounding reaches 1e-8 of the largest number.
constexpr double kRounding = 1e-7;

constexpr WallVelocity parabolic(double speed) {
  return {WallVelocity::Kind::kParabolic, {speed, 0}};
}
constexpr WallVelocity moving(double x, double y) {
  return {WallVelocity::Kind::kConstant, {x, y}};
}

TEST(Channel, WithParabolasAtBothEndsIsPoiseuilleFlow) {
  // A parabola is among the quadratic functions of the mesh.
  auto fluid = fluid_with(12);
  fluid.boundary = SideVelocities{parabolic(2), parabolic(-2), {}, {}};
  PlacedFlow flow(fluid, BoxDomain{{0, 0}, {4, 1}, {}}, {});
  flow.velocities();
  const auto field = flow.solver().flow();
  ASSERT_FALSE(field.x.empty());
  const double pressure = field.pressure[0] + 16 * field.x[0];
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    EXPECT_NEAR(field.velocity_x[i], 8 * field.y[i] * (1 - field.y[i]), kRounding);
    EXPECT_NEAR(field.velocity_y[i], 0, kRounding);
    EXPECT_NEAR(field.pressure[i], pressure - 16 * field.x[i], 1e3 * kRounding);
  }
  EXPECT_NEAR(flow.solver().quantities().dissipation, 256.0 / 3, 1e2 * kRounding);
}

TEST(Channel, WithAPressureGradientIsPoiseuilleFlow) {
  // Periodic along x or y, in other units: u = G/(2 mu) (1 - s^2) at the distance s from the
  // middle.
  for (const std::size_t d : {0U, 1U})
    for (const double unit : {1.0, 1e-5}) {
      auto fluid = fluid_with(12);
      fluid.pressure_gradient[d] = -3 / unit;
      const std::array middle = {7 * unit, -2 * unit};
      BoxDomain box;
      for (const std::size_t e : {0U, 1U}) {
        const double half = (e == d ? 2 : 1) * unit;
        box.from[e] = middle[e] - half;
        box.to[e] = middle[e] + half;
      }
      box.periodic[d] = true;
      auto& probe = fluid.probes.emplace_back();
      probe.name = "across";
      probe.from = probe.to = middle;
      probe.from[1 - d] = d == 0 ? box.from[1] : box.to[0];
      probe.to[1 - d] = d == 0 ? box.to[1] : box.from[0];
      PlacedFlow flow(fluid, box, {});
      flow.velocities();
      const auto field = flow.solver().flow();
      ASSERT_FALSE(field.x.empty());
      for (std::size_t i = 0; i < field.x.size(); ++i) {
        const double s = ((d == 0 ? field.y[i] : field.x[i]) - middle[1 - d]) / unit;
        const auto& along = d == 0 ? field.velocity_x : field.velocity_y;
        const auto& across = d == 0 ? field.velocity_y : field.velocity_x;
        EXPECT_NEAR(along[i] / unit, 1.5 * (1 - s * s), kRounding);
        EXPECT_NEAR(across[i] / unit, 0, kRounding);
        EXPECT_NEAR(field.pressure[i], field.pressure[0], 1e3 * kRounding);
      }
      const auto quantities = flow.solver().quantities();
      EXPECT_NEAR(quantities.dissipation / (unit * unit), 3 * 2 * 4, 1e2 * kRounding);
      EXPECT_NEAR(quantities.probes.at(0)[0] / (unit * unit), 2, 10 * kRounding);
      EXPECT_EQ(quantities.apparent_viscosity, 0);
    }
}

TEST(Channel, WithAPressureGradientCarriesParticles) {
  constexpr double kRadius = 0.05, kGradient = 3, kLength = 4;
  auto fluid = fluid_with(12);
  fluid.pressure_gradient = {-kGradient, 0};
  fluid.probes = {{"across", {0.5, -1}, {0.5, 1}}};
  const BoxDomain box{{0, -1}, {kLength, 1}, {true, false}};
  for (const auto constraint : kConstraints) {
    fluid.constraint = constraint;
    PlacedFlow free(fluid, box, {{2, 0.3, kRadius}});
    const auto motion = free.velocities();
    // Faxen's law in the plane: U = u + r^2/4 div grad u. The walls reflect the flow around the
    // disc, which changes U by a part of r^2 du/dy, and by r^4 in the middle.
    const double faxen = -kRadius * kRadius / 4 * kGradient;
    EXPECT_NEAR(motion[0], 1.5 * (1 - 0.09) + faxen, 2e-3);
    PlacedFlow middle(fluid, box, {{2, 0, kRadius}});
    EXPECT_NEAR(middle.velocities()[0], 1.5 + faxen, 2e-4);
    EXPECT_NEAR(motion[1], 0, 2e-4);
    EXPECT_NEAR(motion[2], 1.5 * 0.3, 2e-3);
    for (const double force : free.solver().quantities().fluid_forces) EXPECT_EQ(force, 0);
    // The gradient gives the whole power. The flow past a fixed disc exerts a force on it.
    PlacedFlow fixed(fluid, box, {{2, 0.3, kRadius}}, {{0, {}}});
    fixed.velocities();
    const auto quantities = fixed.solver().quantities();
    const double power = kGradient * kLength * quantities.probes.at(0)[0];
    EXPECT_NEAR(quantities.dissipation, power, 1e-3 * power);
    EXPECT_LT(power, 0.9 * kGradient * kLength * 2);
    EXPECT_GT(quantities.fluid_forces.at(0), 0);
    // A disc that is driven with the velocity of the free one feels no force.
    PlacedFlow driven(fluid, box, {{2, 0.3, kRadius}}, {{0, {motion[0], motion[1], motion[2]}}});
    driven.velocities();
    EXPECT_NEAR(driven.solver().quantities().fluid_forces.at(0), 0,
                1e-5 * quantities.fluid_forces.at(0));
  }
}

TEST(Channel, WithAPressureGradientAndAnOpenEndIsPoiseuilleFlowAwayFromTheEnds) {
  auto fluid = fluid_with(12);
  fluid.pressure_gradient = {-3, 0};
  const WallVelocity open{WallVelocity::Kind::kOpen, {}};
  fluid.boundary = SideVelocities{open, open, {}, {}};
  PlacedFlow flow(fluid, BoxDomain{{0, -1}, {8, 1}, {}}, {});
  flow.velocities();
  const auto field = flow.solver().flow();
  // Near its ends, where no shear stress acts, the flow has less resistance than between long
  // walls.
  double all = 0, share = 0;
  for (std::size_t i = 0; i < field.x.size(); ++i)
    if (std::abs(field.x[i] - 4) <= 1 && std::abs(field.y[i]) < 0.5) {
      all += 1;
      share += field.velocity_x[i] / (1.5 * (1 - field.y[i] * field.y[i]));
    }
  ASSERT_GT(all, 0);
  share /= all;
  EXPECT_GT(share, 1);
  EXPECT_LT(share, 8 / (8 - 0.5));  // a quarter of the width at each end
  for (std::size_t i = 0; i < field.x.size(); ++i) {
    if (std::abs(field.x[i] - 4) > 1) continue;
    // Of the difference near the ends exp(-4.2 x/H) is left (Moffatt 1964).
    EXPECT_NEAR(field.velocity_x[i], share * 1.5 * (1 - field.y[i] * field.y[i]), 5e-3);
    EXPECT_NEAR(field.velocity_y[i], 0, 5e-3);
  }
}

TEST(Channel, WithAnOpenEndIsPoiseuilleFlowAwayFromIt) {
  // The shear stress of Poiseuille flow is not 0, as that of an open end, so that the flow differs
  // near the end; exp(-4.2 x/H) of the difference is left at a distance x (Moffatt 1964).
  auto fluid = fluid_with(12);
  fluid.boundary = SideVelocities{parabolic(2), {WallVelocity::Kind::kOpen, {}}, {}, {}};
  PlacedFlow flow(fluid, BoxDomain{{0, 0}, {6, 1}, {}}, {});
  flow.velocities();
  const auto field = flow.solver().flow();
  for (std::size_t i = 0; i < field.x.size(); ++i)
    if (field.x[i] < 3) {
      EXPECT_NEAR(field.velocity_x[i], 8 * field.y[i] * (1 - field.y[i]), 1e-4);
    }
}

TEST(Channel, PeriodicAlongItIsSheared) {
  auto fluid = fluid_with(12);
  fluid.boundary = SideVelocities{WallVelocity{}, {}, moving(-1, 0), moving(1, 0)};
  PlacedFlow flow(fluid, BoxDomain{{0, 0}, {4, 2}, {true, false}}, {});
  flow.velocities();
  EXPECT_NEAR(flow.solver().quantities().dissipation, 8, kRounding);
}

TEST(Channel, PeriodicWithOneDiscHasTheExactSpinAndViscosity) {
  const auto exact = reference_discs(VISCONTACT_SOURCE_FOLDER, "sheared, 2a/H = 0.5, cell of 6 H");
  const double width = exact.problem.size, length = exact.problem.length;
  for (const auto constraint : kConstraints) {
    auto fluid = fluid_with(24, constraint);
    fluid.boundary = LinearFlow{{0, 1, 0, 0}};
    // The disc crosses the side of the box.
    PlacedFlow flow(fluid, BoxDomain{{0, -width / 2}, {length, width / 2}, {true, false}},
                    {{0.3, 0}});
    EXPECT_NEAR(flow.velocities()[2], exact.answer.spins[0], 1e-3);
    const auto quantities = flow.solver().quantities();
    const double area = width * length;
    const double added = exact.answer.added_dissipation;
    EXPECT_NEAR(quantities.dissipation / area - 1, added, 5e-3 * added);
    EXPECT_NEAR(quantities.apparent_viscosity, quantities.dissipation / area, 1e-12);
  }
}

TEST(MovingWalls, OfABoxWithoutParticlesMoveTheFluidAsTheyDo) {
  // A linear flow is exact on every mesh, in a box, a disc and an empty cell.
  const LinearFlow strain = {{0.5, 2, -1, -0.5}};
  for (const particles::Domain& domain :
       {particles::Domain(BoxDomain{{-1, 0}, {1, 3}, {}}), particles::Domain(DiscDomain{{1, 0}, 2}),
        particles::Domain(BoxDomain{{-1, 0}, {1, 3}, {true, true}})}) {
    auto fluid = fluid_with(12);
    fluid.boundary = strain;
    PlacedFlow flow(fluid, domain, {});
    flow.velocities();
    const double area = std::holds_alternative<DiscDomain>(domain) ? 4 * pi : 6;
    // 2 D:D = 2 (2 * 0.5^2 + 2 * 0.5^2)
    EXPECT_NEAR(flow.solver().quantities().dissipation, 2 * area, 1e-4 * area);
    EXPECT_NEAR(flow.solver().quantities().apparent_viscosity, 1, 1e-4);
  }
}

TEST(RoundWall, ThatStrainsAConcentricDiscHasTheExactViscosity) {
  // Exactly 1 + 2 phi (1 + phi + phi^2)/(1 - phi)^3, here with phi = 1/16.
  const double phi = 1.0 / 16;
  for (const auto constraint : kConstraints) {
    auto fluid = fluid_with(24, constraint);
    fluid.boundary = LinearFlow{{1, 0, 0, -1}};
    PlacedFlow flow(fluid, DiscDomain{{}, 4}, {{}});
    flow.velocities();
    EXPECT_NEAR(flow.solver().quantities().apparent_viscosity,
                1 + 2 * phi * (1 + phi + phi * phi) / std::pow(1 - phi, 3), 5e-4);
  }
}

TEST(SquareLattice, HasTheExactDragAndViscosities) {
  for (const std::string lattice : {"lattice 0.1", "lattice 0.3"})
    for (const auto constraint : kConstraints) {
      SCOPED_TRACE(lattice);
      const auto exact = [&](const std::string& what) {
        return reference_discs(VISCONTACT_SOURCE_FOLDER, lattice + ", " + what);
      };
      const BoxDomain cell = {{0, 0}, {1, 1}, {true, true}};
      const double radius = exact("force").problem.discs.at(0).radius;
      const std::vector<Body> disc = {{0.3, 0.9, radius}};  // crosses the top
      PlacedFlow pulled(fluid_with(24, constraint), cell, disc);
      // The mean velocity of the mixture is 0, so that the disc moves with minus that of the flow.
      const double mobility = exact("force").answer.velocities.at(0).real();
      EXPECT_NEAR(pulled.velocities({1, 0, 0})[0], mobility, 5e-3 * mobility);
      for (const bool axes : {true, false}) {
        auto fluid = fluid_with(24, constraint);
        fluid.boundary = LinearFlow{axes ? std::array<double, 4>{1, 0, 0, -1}
                                         : std::array<double, 4>{0, 1, 1, 0}};
        PlacedFlow strained(fluid, cell, disc);
        strained.velocities();
        const double viscosity = 1 + exact(axes ? "axes" : "diagonals").answer.added_dissipation;
        EXPECT_NEAR(strained.solver().quantities().apparent_viscosity, viscosity, 5e-3 * viscosity);
      }
    }
}

TEST(Forces, DoTheWorkThatIsDissipated) {
  // Power of the forces on free and driven bodies, walls at rest. On each mesh the two agree but
  // for rounding, because the dissipation is that of the discrete flow.
  const std::vector<Body> discs = {{1, 1, 0.5}, {3, 2, 0.7}};
  const std::vector<double> forces = {1, -0.5, 0.2, 0, 0, 0};
  for (const auto constraint : kConstraints)
    for (const auto mesh : {FluidMesh::kFitted, FluidMesh::kFixed})
      for (const bool periodic : {false, true}) {
        SCOPED_TRACE(::testing::Message() << static_cast<int>(constraint) << static_cast<int>(mesh)
                                          << static_cast<int>(periodic));
        auto fluid = fluid_with(12, constraint);
        fluid.mesh = mesh;
        PlacedFlow flow(fluid, BoxDomain{{0, 0}, {4, 3}, {periodic, periodic}}, discs,
                        {{1, {0.5, 0, 0.2}}});
        const auto v = flow.velocities(forces);
        const auto q = flow.solver().quantities();
        EXPECT_EQ((std::array{v[3], v[4], v[5]}), (std::array{0.5, 0.0, 0.2}));
        const double power =
            v[0] - 0.5 * v[1] + 0.2 * v[2] - 0.5 * q.fluid_forces[3] - 0.2 * q.fluid_forces[5];
        EXPECT_NEAR(q.dissipation, power, 1e-5 * power);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(q.fluid_forces[i], -forces[i]);
        // Without driving, driven bodies are at rest and velocities are linear in the forces.
        const auto at_rest = flow.solver().velocities(forces, false);
        EXPECT_EQ(at_rest[3], 0);
        auto twice = forces;
        for (double& force : twice) force *= 2;
        EXPECT_NEAR(flow.solver().velocities(twice, false)[0], 2 * at_rest[0],
                    1e-5 * std::abs(at_rest[0]));
      }
}

TEST(DrivenDisc, FeelsTheForceThatWouldMoveItSo) {
  for (const auto constraint : kConstraints) {
    const DiscDomain domain = {{}, 5};
    PlacedFlow free(fluid_with(24, constraint), domain, {{2, 0}});
    const auto velocities = free.velocities({0.3, 1, -0.2});
    PlacedFlow driven(fluid_with(24, constraint), domain, {{2, 0}},
                      {{0, {velocities[0], velocities[1], velocities[2]}}});
    driven.velocities();
    const auto forces = driven.solver().quantities().fluid_forces;
    EXPECT_THAT(forces, ::testing::Pointwise(::testing::DoubleNear(1e-5), {-0.3, -1.0, 0.2}));
  }
}

TEST(Inertia, AddsToTheResistance) {
  for (const auto constraint : kConstraints) {
    const DiscDomain domain = {{}, 5};
    PlacedFlow without(fluid_with(24, constraint), domain, {{}});
    const double u = without.velocities({1, 0, 0})[0], w = without.velocities({0, 0, 1})[2];
    PlacedFlow with(fluid_with(24, constraint), domain, {{}}, {}, {7, 7, 3});
    const auto v = with.velocities({1, 0, 2});
    EXPECT_NEAR(v[0], 1 / (1 / u + 7), 1e-5);
    EXPECT_NEAR(v[2], 2 / (1 / w + 3), 1e-5);
    // The fluid exerts F, with f + F = I U.
    EXPECT_NEAR(with.solver().quantities().fluid_forces[0], 7 * v[0] - 1, 1e-9);
  }
}

// Drag over 6 pi mu r U of a sphere on the axis of a closed cylinder of radius 5 and height 10,
// from data/reference/sphere_in_cylinder.csv.
const std::map<double, double> kDragAtGap = {{0.1, 11.5022038}, {1, 2.24503189}, {4, 1.68919777}};

TEST(Sphere, InAClosedCylinderHasTheExactDrag) {
  for (const auto& [gap, drag] : kDragAtGap)
    for (const auto constraint : kConstraints) {
      SCOPED_TRACE(::testing::Message() << "gap " << gap);
      PlacedFlow flow(fluid_with(24, constraint), CylinderDomain{5, 10}, {{0, 1 + gap}});
      const auto estimated = flow.estimate({-1});
      const double velocity = 1 / (6 * pi * drag);
      const double error = std::abs(-estimated.velocities[0] / velocity - 1);
      EXPECT_LT(error, 1e-4);
      EXPECT_LT(error, estimated.of_velocities.best);
    }
}

TEST(Spheres, OnAnAxisAreDrivenAndDissipate) {
  for (const auto constraint : kConstraints) {
    PlacedFlow flow(fluid_with(12, constraint), CylinderDomain{4, 10}, {{0, 3, 1}, {0, 6, 0.5}},
                    {{1, {0.5}}});
    const auto v = flow.velocities({1, 0});
    const auto q = flow.solver().quantities();
    EXPECT_EQ(v[1], 0.5);
    const double power = v[0] - 0.5 * q.fluid_forces[1];
    EXPECT_NEAR(q.dissipation, power, 1e-5 * power);
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
