// Converts between the units of the case and those of a fluid solver (scaled_solver.hpp). Stokes
// flow is linear, so that any unit of velocity would do: it is the unit of length over that of time.
#include "viscontact/freefem_flow/scaled_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"

namespace viscontact::freefem_flow {
namespace {

/// The power of 2 that is nearest to a number > 0.
double power_of_2(double number) { return std::exp2(std::round(std::log2(number))); }

}  // namespace

SolverUnits solver_units(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii) {
  const double length = radii.empty() ? size_of(domain) : std::ranges::min(radii);
  return {power_of_2(length), power_of_2(fluid.viscosity)};
}

particles::Fluid in_units(particles::Fluid fluid, const SolverUnits& units) {
  fluid.viscosity /= units.viscosity;
  fluid.threshold_gap /= units.length;
  if (auto* sides = std::get_if<particles::SideVelocities>(&fluid.boundary))
    for (auto& side : *sides)
      for (auto& component : side.value) component /= units.length;
  return fluid;
}

particles::Domain in_units(particles::Domain domain, const SolverUnits& units) {
  const double unit = units.length;
  if (auto* disc = std::get_if<particles::DiscDomain>(&domain)) {
    for (auto& x : disc->centre) x /= unit;
    disc->radius /= unit;
  } else if (auto* box = std::get_if<particles::BoxDomain>(&domain)) {
    for (auto* corner : {&box->from, &box->to})
      for (auto& x : *corner) x /= unit;
  } else if (auto* cylinder = std::get_if<particles::CylinderDomain>(&domain)) {
    cylinder->radius /= unit;
    cylinder->height /= unit;
  }
  return domain;
}

std::vector<double> in_units(std::span<const double> lengths, const SolverUnits& units) {
  std::vector<double> scaled(lengths.begin(), lengths.end());
  for (auto& length : scaled) length /= units.length;
  return scaled;
}

ScaledSolver::ScaledSolver(const SolverUnits& units, int dimension,
                           std::unique_ptr<particles::FluidSolver> solver)
    : units_(units),
      components_(particles::motion_components(dimension)),
      solver_(std::move(solver)) {
  // In the plane forces and powers are per unit length of the third dimension.
  const double length = units.length, force = units.viscosity * length;
  if (components_ == 3) {
    velocity_units_ = {length, length, 1};
    force_units_ = {force, force, force * length};
    power_unit_ = force * length;
  } else {
    velocity_units_ = {length, 0, 0};
    force_units_ = {force * length, 0, 0};
    power_unit_ = force * length * length;
  }
}

void ScaledSolver::place(const particles::FluidParticles& bodies) {
  particles::Particles scaled;
  scaled.dimension = bodies.particles->dimension;
  scaled.positions = in_units(bodies.particles->positions, units_);
  scaled.radii = in_units(bodies.particles->radii, units_);
  std::vector<double> inertia(bodies.inertia.begin(), bodies.inertia.end());
  for (std::size_t i = 0; i < inertia.size(); ++i)
    inertia[i] *= velocity_units_[i % components_] / force_units_[i % components_];
  auto driven = bodies.driven;
  for (auto& [particle, motion] : driven)
    for (std::size_t c = 0; c < components_; ++c) motion[c] /= velocity_units_[c];
  solver_->place({&scaled, bodies.angles, std::move(driven), inertia});
}

std::vector<double> ScaledSolver::scaled_forces(std::span<const double> forces) const {
  std::vector<double> scaled(forces.begin(), forces.end());
  for (std::size_t i = 0; i < scaled.size(); ++i) scaled[i] /= force_units_[i % components_];
  return scaled;
}

void ScaledSolver::unscale_velocities(std::vector<double>& velocities) const {
  for (std::size_t i = 0; i < velocities.size(); ++i)
    velocities[i] *= velocity_units_[i % components_];
}

std::vector<double> ScaledSolver::velocities(std::span<const double> forces, bool driving) {
  auto velocities = solver_->velocities(scaled_forces(forces), driving);
  unscale_velocities(velocities);
  return velocities;
}

particles::FlowQuantities ScaledSolver::quantities() {
  auto quantities = solver_->quantities();
  quantities.dissipation *= power_unit_;
  for (std::size_t i = 0; i < quantities.fluid_forces.size(); ++i)
    quantities.fluid_forces[i] *= force_units_[i % components_];
  return quantities;
}

particles::FlowField ScaledSolver::flow() {
  auto field = solver_->flow();
  for (auto* lengths : {&field.x, &field.y, &field.velocity_x, &field.velocity_y})
    for (auto& value : *lengths) value *= units_.length;
  for (auto& pressure : field.pressure) pressure *= units_.viscosity;
  return field;
}

}  // namespace viscontact::freefem_flow
