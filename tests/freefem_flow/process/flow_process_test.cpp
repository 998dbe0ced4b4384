// A whole dialogue with a fluid solver: the example of Stokes drag, whose answers are known, and
// shell scripts that write down what they are asked.
#include "viscontact/freefem_flow/process/flow_process.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "tests/common/failure.hpp"
#include "tests/common/temporary_folder.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::CylinderDomain;
using particles::DiscDomain;
using particles::Fluid;
using particles::FluidParticles;
using particles::LinearFlow;
using particles::Particles;
using std::numbers::pi;
using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

// Of numbers of order 1: products of a few factors in another order.
constexpr double kRoundOff = 1e-14;

const SolverCommand kStokesDrag = {
    {"python3", VISCONTACT_SOURCE_FOLDER "/examples/stokes_drag.py"}};

SolverCommand shell(const std::string& script) { return {{"sh", "-c", script}}; }

MeshBoundary no_boundary(const FluidParticles&, double) {
  ADD_FAILURE() << "the solver did not ask for a boundary";
  return {};
}

Fluid fluid_of_viscosity(double viscosity, const std::array<double, 4>& gradient = {}) {
  Fluid fluid;
  fluid.viscosity = viscosity;
  fluid.boundary = LinearFlow{gradient};
  return fluid;
}

Particles particles_at(int dimension, std::vector<double> positions, std::vector<double> radii) {
  Particles particles;
  particles.dimension = dimension;
  particles.positions = std::move(positions);
  particles.radii = std::move(radii);
  return particles;
}

auto near(const std::vector<double>& expected) {
  return Pointwise(DoubleNear(kRoundOff), expected);
}

TEST(StokesDrag, OnAnAxisIsThatOfSpheres) {
  constexpr double kViscosity = 0.5;
  const auto spheres = particles_at(1, {2, 6}, {1, 0.25});
  FlowProcess solver(fluid_of_viscosity(kViscosity), CylinderDomain{5, 10}, shapes_of(spheres), 1,
                     kStokesDrag, no_boundary);
  solver.place({&spheres, {}, {}, {}});
  EXPECT_EQ(solver.unknowns(), 0U);
  const double large = 6 * pi * kViscosity * 1, small = 6 * pi * kViscosity * 0.25;
  const std::vector forces = {-3.0, 2.0};
  const std::vector expected = {-3 / large, 2 / small};
  EXPECT_THAT(solver.velocities(forces, true), near(expected));
  const auto quantities = solver.quantities();
  EXPECT_THAT(quantities.fluid_forces, near({3, -2}));
  EXPECT_NEAR(quantities.dissipation, 9 / large + 4 / small, kRoundOff);
  EXPECT_EQ(quantities.apparent_viscosity, 0);  // the walls are at rest
  const auto estimated =
      particles::estimate_flow(solver, forces, spheres, fluid_of_viscosity(kViscosity));
  EXPECT_THAT(estimated.velocities, near(expected));
  EXPECT_EQ(estimated.of_velocities.best, 0);
  EXPECT_EQ(estimated.of_velocities.of_one_mesh, 0);
  EXPECT_EQ(estimated.of_velocities.of_penalty, 0);
  EXPECT_EQ(estimated.force_errors, (std::vector<double>{0, 0}));
  EXPECT_TRUE(solver.flow().x.empty());
}

TEST(StokesDrag, OnAnAxisTakesInertiaAndDrivenSpheres) {
  const auto spheres = particles_at(1, {2, 6}, {1, 2});
  FlowProcess solver(fluid_of_viscosity(1), CylinderDomain{5, 10}, shapes_of(spheres), 1,
                     kStokesDrag, no_boundary);
  const std::vector inertia = {7.0, 0.0};
  solver.place({&spheres, {}, {{1, {-1.5}}}, inertia});
  const double mobility = 1 / (6 * pi + 7);
  EXPECT_THAT(solver.velocities(std::vector{2.0, 5.0}, true), near({2 * mobility, -1.5}));
  EXPECT_THAT(solver.velocities(std::vector{2.0, 5.0}, false), near({2 * mobility, 0}));
  // quantities are those of the call with `driving`.
  EXPECT_THAT(solver.quantities().fluid_forces,
              Pointwise(DoubleNear(1e-13), {-2 * 6 * pi * mobility, 1.5 * 12 * pi}));
}

TEST(StokesDrag, InThePlaneMovesDiscsWithTheFluid) {
  // Shear u = (y, 0) turns a free disc with -1/2.
  const auto discs = particles_at(2, {0, 0, 3, 2}, {1, 0.5});
  FlowProcess solver(fluid_of_viscosity(2, {0, 1, 0, 0}), DiscDomain{{}, 8}, shapes_of(discs), 2,
                     kStokesDrag, no_boundary);
  const std::vector angles = {0.0, 1.0};
  solver.place({&discs, angles, {}, {}});
  const std::vector<double> forces = {0, 0, 0, 8 * pi, 16 * pi, 2 * pi};
  EXPECT_THAT(solver.velocities(forces, true), near({0, 0, -0.5, 3, 2, 0.5}));
  EXPECT_THAT(solver.velocities(forces, false), near({0, 0, 0, 1, 2, 1}));
  EXPECT_THAT(solver.quantities().fluid_forces,
              Pointwise(DoubleNear(1e-13), {0.0, 0.0, 0.0, -8 * pi, -16 * pi, -2 * pi}));
  // New places, with one disc driven and inertia of the other.
  const std::vector<double> inertia = {0, 0, 0, 8 * pi, 24 * pi, 6 * pi};
  solver.place({&discs, angles, {{0, {1, 2, 3}}}, inertia});
  EXPECT_THAT(solver.velocities(forces, true), near({1, 2, 3, 1.5, 0.5, 0.125}));
}

TEST(StokesDrag, AnswersForManyStepsAndParticles) {
  constexpr std::size_t kCount = 1000;
  std::vector<double> positions(2 * kCount), forces(3 * kCount);
  for (std::size_t i = 0; i < forces.size(); ++i) forces[i] = 4 * pi * std::sin(i);
  const auto discs = particles_at(2, positions, std::vector<double>(kCount, 1.0));
  const std::vector<double> angles(kCount);
  FlowProcess solver(fluid_of_viscosity(1), DiscDomain{{}, 8}, shapes_of(discs), 2, kStokesDrag,
                     no_boundary);
  for (int step = 0; step < 3; ++step) {
    solver.place({&discs, angles, {}, {}});
    for (int i = 0; i < 3; ++i) {
      const auto velocities = solver.velocities(forces, false);
      ASSERT_EQ(velocities.size(), forces.size());
      for (std::size_t k = 0; k < forces.size(); ++k)
        ASSERT_NEAR(velocities[k], std::sin(k), kRoundOff);
    }
  }
}

/// Answers to everything in order, as a file; what comes is written to the file `asked`.
constexpr const char* kScripted = R"sh(
echo 'init MUMPS_SEQ: 0 1'
echo 'ready boundary'
sed -u -n -e "w asked
/^place/,/^9 9 9/{/^9 9 9/i placed 1234
}
/^solve/i velocities 0.1\n-2e-3 +5
/^quantities/i quantities 12 4 1 2 3
/^vary penalty/i varied 2
/^vary mesh/i varied 1.5 .25 2
/^flow/i flow 6 1  0 0 1 2 3  1 0 1 2 3  0 1 1 2 3  .5 0 1 2 3  .5 .5 1 2 3  0 .5 7 8 9  0 1 2 3 4 5
/^end/q"
)sh";

TEST(FlowProcess, WritesTheProtocolAndReadsIt) {
  const TemporaryFolder folder;
  auto command = shell(kScripted);
  command.folder = folder.path().string();
  const auto disc = particles_at(2, {0.1, -1}, {1});
  {
    FlowProcess solver(fluid_of_viscosity(1), DiscDomain{{}, 8}, shapes_of(disc), 2, command,
                       [&](const FluidParticles& bodies, double) {
                         EXPECT_EQ(bodies.particles, &disc);
                         return MeshBoundary{{{0, 0}, {0.5, 1}}, {{0, 1, 100}, {9, 9, 9}}};
                       });
    const std::vector angles = {0.25};
    const std::vector inertia = {1.0, 1.0, 0.5};
    solver.place({&disc, angles, {{0, {1, 2, 3}}}, inertia});
    EXPECT_EQ(solver.unknowns(), 1234U);
    EXPECT_THAT(solver.velocities(std::vector{1.0, 0.0, 1.0 / 3}, true),
                ElementsAre(0.1, -2e-3, 5));
    EXPECT_THAT(solver.velocities(std::vector{0.0, 0.0, 0.0}, false), ElementsAre(0.1, -2e-3, 5));
    const auto quantities = solver.quantities();
    EXPECT_EQ(quantities.dissipation, 12);
    EXPECT_EQ(quantities.apparent_viscosity, 3);
    EXPECT_THAT(quantities.fluid_forces, ElementsAre(1, 2, 3));
    EXPECT_EQ(solver.vary_penalty(), 2);
    const auto second = solver.vary_mesh();
    EXPECT_EQ(second.extrapolation, 1.5);
    EXPECT_EQ(second.error, 0.25);
    EXPECT_EQ(second.error_of_one_mesh, 2);
    const auto flow = solver.flow();
    EXPECT_THAT(flow.x, ElementsAre(0, 1, 0, 0.5, 0.5, 0));
    EXPECT_THAT(flow.y, ElementsAre(0, 0, 1, 0, 0.5, 0.5));
    EXPECT_THAT(flow.velocity_x, ElementsAre(1, 1, 1, 1, 1, 7));
    EXPECT_THAT(flow.velocity_y, ElementsAre(2, 2, 2, 2, 2, 8));
    EXPECT_THAT(flow.pressure, ElementsAre(3, 3, 3, 3, 3, 9));
    ASSERT_EQ(flow.triangles.size(), 1U);
    EXPECT_THAT(flow.triangles[0], ElementsAre(0, 1, 2, 3, 4, 5));
  }
  const auto asked = read_file(folder.path() / "asked");
  EXPECT_EQ(asked.substr(asked.find("place\n")),
            "place\n 0.1 -1 0.25\ndriven 1\n0 1 2 3\ninertia 3 1 1 0.5\n"
            "boundary 2 2\n 0 0\n 0.5 1\n0 1 100\n9 9 9\n"
            "solve 1 1 0 0.3333333333333333\n"
            "solve 0 0 0 0\n"
            "quantities\n"
            "vary penalty\n"
            "vary mesh\n"
            "flow\n"
            "end\n");
}

TEST(FlowProcess, RefusesNumbersThatAreNotFinite) {
  const auto disc = particles_at(2, {0, 0}, {1});
  FlowProcess solver(fluid_of_viscosity(1), DiscDomain{{}, 8}, shapes_of(disc), 2, kStokesDrag,
                     no_boundary);
  const std::vector angles = {0.0};
  solver.place({&disc, angles, {}, {}});
  const std::vector<double> forces = {0, std::numeric_limits<double>::quiet_NaN(), 0};
  EXPECT_THAT(failure(ErrorKind::kNotConverged, [&] { solver.velocities(forces, true); }),
              Names("force", "nan"));
  // The solver was not asked and answers the next request.
  EXPECT_THAT(solver.velocities(std::vector{0.0, 0.0, 0.0}, true), ElementsAre(0, 0, 0));
}

TEST(FlowProcess, EndsAtAStopRequest) {
  std::atomic<bool> stop = false;
  const auto disc = particles_at(2, {0, 0}, {1});
  FlowProcess solver(fluid_of_viscosity(1), DiscDomain{{}, 8}, shapes_of(disc), 2,
                     shell("echo ready places; exec sleep 3600"), no_boundary,
                     {std::chrono::minutes(10), StopToken(stop)});
  stop = true;
  const std::vector angles = {0.0};
  EXPECT_THAT(failure(ErrorKind::kInterrupted,
                      [&] {
                        solver.place({&disc, angles, {}, {}});
                      }),
              Names("interrupted"));
}

}  // namespace
}  // namespace viscontact::freefem_flow
