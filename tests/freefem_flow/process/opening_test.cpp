// The opening of the protocol, word by word as docs/fluid-solver.md has it.
#include "viscontact/freefem_flow/process/opening.hpp"

#include <gmock/gmock.h>

#include <array>
#include <string>

#include "tests/common/failure.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::BoxDomain;
using particles::CylinderDomain;
using particles::DiscDomain;
using particles::Fluid;
using particles::LinearFlow;
using particles::Shape;
using particles::SideVelocities;
using particles::WallVelocity;
using ::testing::HasSubstr;

/// Of viscosity 0.1, which has no exact double, and otherwise with defaults.
Fluid fluid_with(decltype(Fluid::boundary) boundary) {
  Fluid fluid;
  fluid.viscosity = 0.1;
  fluid.boundary = std::move(boundary);
  return fluid;
}

TEST(Opening, SaysAllThatTheSolverMustKnow) {
  const auto fluid = fluid_with(LinearFlow{{0, 1.5, 0, 0}});
  EXPECT_EQ(
      opening(fluid, DiscDomain{{1, -2, 0}, 8}, std::array{Shape::disc(1), Shape::disc(0.25)}, 2),
      "viscontact-fluid 2\n"
      "dimension 2\n"
      "viscosity 0.1\n"
      "constraint penalty 1e-07\n"
      "mesh fitted\n"
      "edges 24\n"
      "domain disc 1 -2 8\n"
      "walls 1\n"
      "1 moving 0 0 1.5 0 0 0 0 0\n"
      "gradient 0 0 0 0\n"
      "particles 2\n"
      "1\n"
      "0.25\n");
}

TEST(Opening, NamesTheOtherConstraintAndMesh) {
  auto fluid = fluid_with(LinearFlow{});
  fluid.constraint = particles::RigidConstraint::kRigid;
  fluid.mesh = particles::FluidMesh::kFixed;
  fluid.edges_per_particle = 48;
  const auto text = opening(fluid, CylinderDomain{5, 10}, {}, 1);
  EXPECT_THAT(text, HasSubstr("dimension 1\n"));
  EXPECT_THAT(text, HasSubstr("constraint rigid 0\nmesh fixed\nedges 48\ndomain cylinder 5 10\n"
                              "walls 3\n1 moving 0 0 0 0 0 0 0 0\n2 moving 0 0 0 0 0 0 0 0\n"
                              "3 moving 0 0 0 0 0 0 0 0\n"));
  EXPECT_THAT(text, HasSubstr("particles 0\n"));
}

TEST(Opening, GivesEachSideOfABoxItsVelocity) {
  const WallVelocity parabolic = {WallVelocity::Kind::kParabolic, {2, 0}};
  const auto fluid = fluid_with(SideVelocities{
      parabolic, {WallVelocity::Kind::kOpen, {}}, {WallVelocity::Kind::kConstant, {1, -3}}, {}});
  const auto text = opening(fluid, BoxDomain{{0, 0}, {2, 6}, {}}, {}, 2);
  EXPECT_THAT(text, HasSubstr("domain box 0 0 2 6 0 0\n"
                              "walls 4\n"
                              "1 moving 0 0 0 0 0 0 2 0\n"
                              "2 open 0 0 0 0 0 0 0 0\n"
                              "3 moving 1 0 0 -3 0 0 0 0\n"
                              "4 moving 0 0 0 0 0 0 0 0\n"));
}

TEST(Opening, AParabolaGoesInwardsThroughEverySide) {
  const WallVelocity in = {WallVelocity::Kind::kParabolic, {2, 0}};
  const auto text =
      opening(fluid_with(SideVelocities{in, in, in, in}), BoxDomain{{0, 0}, {1, 1}, {}}, {}, 2);
  EXPECT_THAT(text, HasSubstr("1 moving 0 0 0 0 0 0 2 0\n"
                              "2 moving 0 0 0 0 0 0 -2 0\n"
                              "3 moving 0 0 0 0 0 0 0 2\n"
                              "4 moving 0 0 0 0 0 0 0 -2\n"));
}

TEST(Opening, LeavesOutPeriodicSides) {
  const auto sheared = fluid_with(LinearFlow{{0, 3, 0, 0}});
  EXPECT_THAT(opening(sheared, BoxDomain{{0, 0}, {1, 1}, {true, false}}, {}, 2),
              HasSubstr("domain box 0 0 1 1 1 0\n"
                        "walls 2\n"
                        "3 moving 0 0 3 0 0 0 0 0\n"
                        "4 moving 0 0 3 0 0 0 0 0\n"
                        "gradient 0 0 0 0\n"));
  EXPECT_THAT(opening(sheared, BoxDomain{{0, 0}, {1, 1}, {true, true}}, {}, 2),
              HasSubstr("walls 0\ngradient 0 3 0 0\n"));
}

TEST(Opening, RefusesADomainThatDoesNotFit) {
  const auto at_rest = fluid_with(LinearFlow{});
  bad_input([&] { opening(at_rest, std::monostate{}, {}, 2); });
  bad_input([&] { opening(at_rest, DiscDomain{{}, 1}, {}, 1); });
  bad_input([&] { opening(at_rest, CylinderDomain{1, 1}, {}, 2); });
  bad_input([&] { opening(fluid_with(SideVelocities{}), DiscDomain{{}, 1}, {}, 2); });
}

}  // namespace
}  // namespace viscontact::freefem_flow
