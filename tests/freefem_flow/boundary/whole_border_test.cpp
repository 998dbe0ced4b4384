// FreeFEM joins points of a boundary without a word; the scripts notice it.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/common/failure.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/freefem_flow/process/flow_process.hpp"

namespace viscontact::freefem_flow {
namespace {

/// Places an octagon of radius 0.25 in the unit square, with a corner straight above a point of the
/// floor at the distance `gap`. Its edges of 0.19 are the shortest ones.
void place_octagon(double gap, particles::RigidConstraint constraint) {
  particles::Fluid fluid;
  fluid.viscosity = 1;
  fluid.constraint = constraint;
  const double height = 0.25 + gap;
  const auto boundary = [&](const particles::FluidParticles&, double) {
    MeshBoundary made;
    made.add({{0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}, {1, 0}}, 3);
    made.add({{1, 0}, {1, 0.5}, {1, 1}}, 2);
    made.add({{1, 1}, {0.5, 1}, {0, 1}}, 4);
    made.add({{0, 1}, {0, 0.5}, {0, 0}}, 1);
    std::vector<std::array<double, 2>> octagon;
    for (int i = 0; i <= 8; ++i) {
      const double angle = -std::numbers::pi / 2 - std::numbers::pi / 4 * (i % 8);
      octagon.push_back({0.5 + 0.25 * std::cos(angle), height + 0.25 * std::sin(angle)});
    }
    made.add(octagon, kFirstParticleLabel);
    return made;
  };
  particles::Particles disc;
  disc.dimension = 2;
  disc.positions = {0.5, height};
  disc.radii = {0.25};
  const std::vector<double> angles = {0};
  FlowProcess solver(fluid, particles::BoxDomain{{0, 0}, {1, 1}}, shapes_of(disc), 2,
                     solver_command(fluid, 2), boundary);
  solver.place({&disc, angles, {}, {}});
}

// 1/16 of the shortest edge is 0.012.
TEST(WholeBorder, PointsThatFreefemJoinsAreAnError) {
  for (const auto constraint :
       {particles::RigidConstraint::kRigid, particles::RigidConstraint::kPenalty}) {
    EXPECT_THAT(failure(ErrorKind::kExternalProgram, [&] { place_octagon(0.01, constraint); }),
                Names("1/16"));
    EXPECT_NO_THROW(place_octagon(0.015, constraint));
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
