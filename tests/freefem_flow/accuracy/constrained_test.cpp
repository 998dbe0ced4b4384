// Rigid bodies, hinges, springs and arms in the fluid of FreeFEM, whose mobility has errors: across
// the sides of sheared cells, and springs of all stiffnesses.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::RigidConstraint;
using particles::Vector;
using particles::operator-;  // NOLINT(misc-unused-using-decls): clang-tidy overlooks operators

constexpr std::array kConstraints = {RigidConstraint::kPenalty, RigidConstraint::kRigid};

/// Discs of radius 0.2 without mass in a box of side 2 about `middle`, which is periodic both ways
/// with the mean flow `gradient`, and their links.
struct CellOfDiscs {
  RigidConstraint constraint = RigidConstraint::kPenalty;
  std::array<double, 4> gradient{};
  Vector middle{};
  std::vector<Vector> discs{};
  std::vector<std::int32_t> body{};  ///< discs that are one body
  particles::Links links{};
  double h = 1e-3;
  std::map<std::int32_t, Vector> forces{};  ///< force and torque on a disc
  int edges = 12;

  particles::PeriodicCell cell() const {
    return {{middle[0] - 1, middle[1] - 1}, {2, 2}, gradient};
  }

  particles::FluidSimulation simulation() const {
    particles::Setting setting;
    setting.domain = particles::BoxDomain{
        {middle[0] - 1, middle[1] - 1}, {middle[0] + 1, middle[1] + 1}, {true, true}};
    setting.fluid = fluid_with(edges, constraint);
    setting.fluid->boundary = particles::LinearFlow{gradient};
    setting.fluid->threshold_gap = 0.001;
    setting.time_step = h;
    setting.links = links;
    for (const auto& [k, force] : forces) {
      setting.forces[k] = {{{1e300, {force[0], force[1], 0}}}};
      setting.torques[k] = {{{1e300, {0, 0, force[2]}}}};
    }
    particles::State state;
    auto& p = state.particles;
    p.dimension = 2;
    p.cell = cell();
    for (const auto& disc : discs) {
      for (std::size_t d = 0; d < 2; ++d)
        p.positions.push_back(disc[d] - 2 * particles::periods_beyond(p.cell, d, disc[d]));
      p.radii.push_back(0.2);
      p.masses.push_back(0);
    }
    p.velocities.assign(2 * discs.size(), 0);
    p.angles.assign(discs.size(), 0);
    p.angular_velocities.assign(discs.size(), 0);
    p.inertias.assign(discs.size(), 0);
    if (!body.empty()) add_rigid_body(p, {body});
    return {setting, state,
            start_fluid_solver(*setting.fluid, setting.domain, shapes_of(p), p.dimension)};
  }
};

/// The apparent viscosity, the forces of the links, and the velocities relative to the mean flow.
std::vector<double> result_of(const CellOfDiscs& c) {
  auto simulation = c.simulation();
  const auto before = simulation.state().particles;
  const auto report = simulation.step(c.h);
  const auto& p = simulation.state().particles;
  std::vector<double> numbers = {report.fluid.apparent_viscosity};
  const auto& forces = simulation.state().link_forces;
  numbers.insert(numbers.end(), forces.begin(), forces.end());
  for (std::size_t k = 0; k < p.count(); ++k) {
    const Vector v = p.velocity(k) - velocity_at(p.cell, before.position(k) - c.middle);
    numbers.insert(numbers.end(), {v[0], v[1], p.angular_velocities[k]});
  }
  return numbers;
}

/// Largest difference of two results, over the largest number.
double difference(const std::vector<double>& one, const std::vector<double>& other) {
  double largest = 0, apart = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    largest = std::max(largest, std::abs(other[i]));
    apart = std::max(apart, std::abs(one[i] - other[i]));
  }
  return apart / largest;
}

// The mesh is another one where a side cuts what links join: the narrow parts between the discs are
// then meshed along the edges where it is cut. Results of the two meshes differ by 4e-5 for the
// body of two discs with 12 edges, and for the links below by 4e-3 with 12 edges and by less than
// 3e-4 with 24, as errors of the mesh do, which fall as the fourth power.
constexpr double kOfMesh = 3e-4;

TEST(ShearedCell, TurnsABodyAcrossItsSideAsOneInside) {
  for (const auto constraint : kConstraints) {
    CellOfDiscs c{constraint, {0, 1, 0, 0}, {}, {{0, 0.55, 0}, {0, -0.85, 0}}, {0, 1}, {}};
    const auto across = result_of(c);
    EXPECT_NEAR(across[0], 1.136, 0.001);  // apparent viscosity
    EXPECT_NEAR(across[3], -0.83, 0.005);  // angular velocity
    c.middle = {0, 0.85, 0};
    EXPECT_LT(difference(result_of(c), across), kOfMesh);
  }
}

TEST(ShearedCell, HasTheSameLinksWhereverItBegins) {
  for (const auto& gradient :
       {std::array<double, 4>{0, 1, 0, 0}, std::array<double, 4>{0.7, 0, 0, -0.7}}) {
    CellOfDiscs c{RigidConstraint::kRigid, gradient};
    c.edges = 16;
    c.discs = {{-0.2, -0.3, 0}, {0.2, 0.2, 0}, {0.7, 0.5, 0}, {-0.5, -0.75, 0}};
    c.body = {0, 1};
    const double length = std::hypot(0.5, 0.3);
    c.links.arms = {{1, 2, particles::PiecewiseLinearLength{{{0, length}, {1, length + 1}}}}};
    c.links.springs = {{3, 0, 4, 0.5}};
    const auto inside = result_of(c);
    c.middle = {1, 1, 0};  // the sides pass through the body
    const auto across = result_of(c);
    EXPECT_LT(difference(across, inside), kOfMesh * std::pow(24.0 / 16, 4));
    if (gradient[0] != 0) continue;
    // Where the same images are in the box, the mesh is the same, up to rounding errors.
    c.middle = {1.06, 0.95, 0};
    EXPECT_LT(difference(result_of(c), across), 1e-9);
  }
}

/// The force of a hinge and the torque of its spring move a body inside a cell in such a way that
/// the point of the hinge has minus the mean flow where it was held.
TEST(ShearedCell, HoldsAHingeAcrossItsSide) {
  CellOfDiscs c{RigidConstraint::kRigid, {0, 1, 0, 0}, {0, 0.9, 0}};
  c.discs = {{0, -0.3, 0}, {0.1, 0.25, 0}};
  c.body = {0, 1};
  const auto placed = c.simulation().state().particles;
  particles::Hinge hinge;
  hinge.body = 0;
  hinge.at = placed.position(1);
  hinge.point = {1, nearest_image(placed.cell, hinge.at - placed.bodies.bodies[0].centre)};
  hinge.stiffness = 2;
  hinge.rest_angle = 0.4;
  c.links.hinges = {hinge};
  const auto held = result_of(c);
  c.links.hinges = {};
  c.middle = {};
  c.forces[1] = {held[1], held[2], held[3]};
  auto freed = result_of(c);
  freed.insert(freed.begin() + 1, held.begin() + 1, held.begin() + 4);
  // The force multiplies the errors of the meshes. The dissipation is not relative to the mean flow
  // only, because the hinge does work on it.
  EXPECT_LT(difference({held.begin() + 4, held.end()}, {freed.begin() + 4, freed.end()}),
            3 * kOfMesh);
}

TEST(Stiffness, OfATorsionSpringOnABodyDoesNotEndWhatMakesItRigid) {
  for (const auto constraint : kConstraints) {
    const auto forces = [&](double h, double k) {
      CellOfDiscs c{constraint, {}, {}, {{-0.3, 0, 0}, {0.3, 0.1, 0}}, {0, 1}, {}, h};
      particles::Hinge hinge;
      hinge.body = 0;
      hinge.at = {-0.3, 0.05, 0};
      hinge.point = {0, {0, 0, 0}};
      hinge.point.offset = hinge.at - Vector{0, 0.05, 0};
      hinge.stiffness = k;
      hinge.rest_angle = 0.5;
      c.links.hinges = {hinge};
      auto simulation = c.simulation();
      simulation.step(h);
      return simulation.state().link_forces;
    };
    const auto right = forces(1e-5, 1);
    EXPECT_NEAR(right[2], 0.5, 1e-4);
    // Forces differ by h k over the resistance, which is about 1, and by the errors of the answers.
    EXPECT_LT(difference(forces(1e-9, 1), right), 1e-4);
    constexpr double kSoft = 1e-12;
    auto soft = forces(0.1, kSoft);
    for (auto& f : soft) f /= kSoft;
    EXPECT_LT(difference(soft, right), 1e-4);
    // A stiff spring turns the body to its rest angle in the step, whatever its stiffness.
    EXPECT_LT(difference(forces(0.1, 1e12), forces(0.1, 1e8)), 1e-4);
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
