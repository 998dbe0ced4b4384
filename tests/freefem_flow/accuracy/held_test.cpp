// Rigid bodies, hinges, springs and arms in the fluid of FreeFEM: across the sides of sheared cells,
// and springs of all stiffnesses. The mobility that they need is that of FreeFEM, with its errors.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/freefem_flow/placed_flow.hpp"
#include "viscontact/particles/bodies/rigid_bodies.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"

namespace viscontact::freefem_flow {
namespace {

using particles::RigidConstraint;
using particles::Vector;

constexpr std::array kConstraints = {RigidConstraint::kPenalty, RigidConstraint::kRigid};

/// Discs of radius 0.2 without mass in a box of side 2 about `middle`, which is periodic both ways
/// with the mean flow `gradient`, and their links.
struct CellOfDiscs {
  RigidConstraint constraint = RigidConstraint::kPenalty;
  std::array<double, 4> gradient{};
  Vector middle{};
  std::vector<Vector> discs;
  std::vector<std::int32_t> body;  ///< discs that are one body
  particles::Links links;
  double h = 1e-3;

  particles::PeriodicCell cell() const {
    return {{middle[0] - 1, middle[1] - 1}, {2, 2}, gradient};
  }

  particles::FluidSimulation simulation() const {
    particles::Setting setting;
    setting.domain =
        particles::BoxDomain{{middle[0] - 1, middle[1] - 1}, {middle[0] + 1, middle[1] + 1},
                             {true, true}};
    setting.fluid = fluid_with(12, constraint);
    setting.fluid->boundary = particles::LinearFlow{gradient};
    setting.fluid->threshold_gap = 0.001;
    setting.time_step = h;
    setting.links = links;
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
            start_fluid_solver(*setting.fluid, setting.domain, p.radii, p.dimension)};
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

TEST(Probe, Shifts) {
  for (const auto constraint : kConstraints) {
    CellOfDiscs c{constraint, {0, 1, 0, 0}, {}, {{0, -0.6, 0}, {0, 0, 0}}, {0, 1}, {}};
    for (const Vector& shift : {Vector{}, Vector{0, -0.85, 0}, Vector{0.3, -0.85, 0}, Vector{0.25, 0.5, 0}, Vector{1,1,0}, Vector{0.125,-0.75,0}, Vector{-0.9, 0.123, 0}}) {
      c.middle = shift;
      const auto numbers = result_of(c);
      printf("%d %.3f %.3f:", int(constraint), shift[0], shift[1]);
      for (double x : numbers) printf(" %.12g", x);
      printf("\n");
    }
  }
}

}  // namespace
}  // namespace viscontact::freefem_flow
