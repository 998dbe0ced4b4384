// Stokes flow around membranes, computed by FreeFEM.
#include "viscontact/freefem_flow/membranes/membrane_process.hpp"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/common/failure.hpp"
#include "viscontact/common/error.hpp"
#include "viscontact/freefem_flow/freefem_solver.hpp"
#include "viscontact/membranes/membrane_curve.hpp"
#include "viscontact/membranes/membrane_shape.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::Membrane;

/// A vesicle of area pi unit^2 in a box of 8 x 6 units, or `room` times as large, that is periodic
/// along x and sheared. The middle of the box is at (x, 0).
struct Scene {
  double unit = 1, viscosity = 1, ratio = 1, shear = 1, gradient = 0, room = 1, x = 0;
  particles::Vector centre{};
  std::vector<double> places{};
  particles::Particles beads{};
  std::unique_ptr<particles::FluidSolver> solver{};

  void start(int edges, int count = 24) {
    Membrane membrane;
    membrane.set_beads(0, count);
    membrane.viscosity_ratio = ratio;
    membrane.area = std::numbers::pi * unit * unit;
    membrane.perimeter = unit * 2 * std::numbers::pi / std::sqrt(0.85);
    particles::Fluid fluid;
    fluid.viscosity = viscosity;
    fluid.edges_per_particle = edges;
    fluid.boundary = particles::LinearFlow{{0, shear, 0, 0}};
    fluid.pressure_gradient = {gradient, 0};
    fluid.membranes = {membrane};
    const double size = room * unit;
    const particles::BoxDomain box{
        {x - 4 * size, -3 * size}, {x + 4 * size, 3 * size}, {true, false}};
    places = *particles::ellipse_of(membrane, centre, 0.5);
    for (std::size_t i = 0; i < places.size(); i += 2) places[i] += x;
    beads.positions = places;
    beads.velocities.resize(places.size());
    beads.radii.assign(places.size() / 2, 0.01 * unit);
    beads.masses.resize(places.size() / 2);
    solver = start_fluid_solver(fluid, box, shapes_of(beads), 2);
    std::vector<double> angles(beads.radii.size());
    solver->place({&beads, angles, {}, {}});
  }
  std::size_t size() const { return 3 * beads.radii.size(); }
};

// A linear flow is exact on each mesh, also across the period.
TEST(MembraneProcess, WithoutForcesAndWithOneFluidTheFlowIsThatOfTheWalls) {
  Scene scene{.centre = {3.9, 0.3, 0}};
  scene.start(12);
  const auto velocities = scene.solver->velocities(std::vector<double>(scene.size()), true);
  for (std::size_t k = 0; k < scene.places.size() / 2; ++k) {
    EXPECT_NEAR(velocities[3 * k], scene.places[2 * k + 1], 1e-9);
    EXPECT_NEAR(velocities[3 * k + 1], 0, 1e-9);
    EXPECT_EQ(velocities[3 * k + 2], 0);
  }
}

TEST(MembraneProcess, WithoutForcesAndWithOneFluidAPressureGradientGivesPoiseuilleFlow) {
  Scene scene{.viscosity = 2, .shear = 0, .gradient = -4, .centre = {3.9, 0.3, 0}};
  scene.start(24);
  const auto velocities = scene.solver->velocities(std::vector<double>(scene.size()), true);
  // On the curved edges of the membrane a parabola is not exact.
  for (std::size_t k = 0; k < scene.places.size() / 2; ++k) {
    const double y = scene.places[2 * k + 1];
    EXPECT_NEAR(velocities[3 * k], 9 - y * y, 2e-3);
    EXPECT_NEAR(velocities[3 * k + 1], 0, 2e-3);
  }
  // Gradient times flux times length.
  EXPECT_NEAR(scene.solver->quantities().dissipation / (4 * 36 * 8), 1, 1e-5);
}

// Equal forces per length along the normal are a pressure inside. The pressure of the solver jumps
// across the membrane, so that it holds this force without a flow, to the error of the edges: a
// pressure that does not jump gives velocities of a tenth.
TEST(MembraneProcess, APressureInsideMovesNothing) {
  Scene scene;
  scene.start(24, 24);
  const auto n = static_cast<Eigen::Index>(scene.places.size() / 2);
  Eigen::VectorXd positions(2 * n);
  for (Eigen::Index i = 0; i < 2 * n; ++i)
    positions((i % 2) * n + i / 2) = scene.places[static_cast<std::size_t>(i)];
  // A pressure does work if the area changes.
  const auto pressure = particles::MembraneCurve(static_cast<int>(n)).area_row(positions);
  std::vector<double> forces(scene.size());
  for (Eigen::Index i = 0; i < 2 * n; ++i)
    forces[static_cast<std::size_t>(3 * (i / 2) + i % 2)] = pressure((i % 2) * n + i / 2);
  for (const double v : scene.solver->velocities(forces, false)) EXPECT_NEAR(v, 0, 1e-3);
}

TEST(MembraneProcess, TheMobilityIsSymmetricAndThatOfSingleForces) {
  Scene scene{.ratio = 3, .shear = 0};
  scene.start(12);
  const auto size = scene.size();
  const auto mobility = scene.solver->mobility(size);
  double largest = 0;
  for (const double m : mobility) largest = std::max(largest, std::abs(m));
  for (std::size_t i = 0; i < size; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_NEAR(mobility[i * size + j], mobility[j * size + i], 1e-9 * largest);
  std::vector<double> force(size);
  force[3 * 7 + 1] = 2;
  const auto velocities = scene.solver->velocities(force, true);
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_NEAR(velocities[i], 2 * mobility[(3 * 7 + 1) * size + i], 1e-9 * largest);
  // The power of the force is the dissipation.
  EXPECT_NEAR(scene.solver->quantities().dissipation, 2 * velocities[3 * 7 + 1], 1e-9 * largest);
}

// A vesicle anywhere in the period, and in other units, has the same answer up to rounding errors
// of the mesh.
TEST(MembraneProcess, PlaceAndUnitsDoNotMatter) {
  const auto answer = [](Scene scene, double force_unit) {
    scene.start(12);
    std::vector<double> forces(scene.size());
    forces[3 * 5] = force_unit;
    auto velocities = scene.solver->velocities(forces, true);
    for (auto& v : velocities) v /= scene.unit * scene.shear;
    return velocities;
  };
  const auto first = answer({.ratio = 4}, 1);
  const auto shifted = answer({.ratio = 4, .centre = {2.7, 0, 0}}, 1);
  const auto scaled = answer({.unit = 1024, .viscosity = 0.25, .ratio = 4, .shear = 8}, 2 * 1024);
  const auto far = answer({.ratio = 4, .x = 1e8}, 1);
  for (std::size_t i = 0; i < first.size(); ++i) {
    // The same mesh up to rounding errors of its points, but FreeFEM may then choose other
    // triangles. Far away positions are rounded to 1.5e-8.
    EXPECT_NEAR(shifted[i], first[i], 2e-3);
    EXPECT_NEAR(far[i], first[i], 4e-3);
    EXPECT_NEAR(scaled[i], first[i], 1e-9);
  }
}

TEST(MembraneProcess, AMembraneThatIsTooSmallForTheDomainIsAnError) {
  Scene scene{.room = 1e6};
  EXPECT_THAT(bad_input([&] { scene.start(12); }), Names("perimeter", "28.2"));
}

TEST(MembraneProcess, AMembraneOutsideTheDomainIsAnError) {
  Scene scene{.centre = {0, 2.5, 0}};
  EXPECT_THAT(failure(ErrorKind::kNotConverged, [&] { scene.start(12); }),
              Names("membrane", "domain"));
}

}  // namespace
}  // namespace viscontact::freefem_flow
