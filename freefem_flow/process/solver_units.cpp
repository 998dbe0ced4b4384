// Changes a fluid, its domain and its particles to the units of the solver.
#include "viscontact/freefem_flow/process/solver_units.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <variant>

#include "viscontact/freefem_flow/boundary/edge_lengths.hpp"

namespace viscontact::freefem_flow {
namespace {

/// The power of 2 whose logarithm is nearest to that of `number`.
double power_of_2(double number) {
  assert(number > 0);
  return std::exp2(std::round(std::log2(number)));
}

/// Changes the first two numbers of `place`.
template <class Place>
void change_place(Place& place, const SolverUnits& units) {
  for (std::size_t d = 0; d < 2; ++d) place[d] = (place[d] - units.origin[d]) / units.length;
}

}  // namespace

SolverUnits solver_units(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii) {
  const double length = radii.empty() ? size_of(domain) : std::ranges::min(radii);
  const auto corner = particles::distant_corner(domain);
  return {power_of_2(length), power_of_2(fluid.viscosity), {corner[0], corner[1]}};
}

particles::Fluid in_units(particles::Fluid fluid, const SolverUnits& units) {
  fluid.viscosity /= units.viscosity;
  fluid.threshold_gap /= units.length;
  for (auto& area : fluid.cut_areas) area /= units.length * units.length;
  fluid.density /= units.viscosity / (units.length * units.length);
  for (auto& membrane : fluid.membranes) {
    membrane.bending_rigidity /= units.viscosity * units.length * units.length * units.length;
    membrane.perimeter /= units.length;
    membrane.area /= units.length * units.length;
  }
  for (auto& probe : fluid.probes)
    for (auto* place : {&probe.from, &probe.to}) change_place(*place, units);
  for (auto& gradient : fluid.pressure_gradient) gradient /= units.viscosity / units.length;
  if (auto* flow = std::get_if<particles::LinearFlow>(&fluid.boundary))
    for (std::size_t d = 0; d < 2; ++d)
      flow->at_origin[d] = (flow->at_origin[d] + flow->gradient[2 * d] * units.origin[0] +
                            flow->gradient[2 * d + 1] * units.origin[1]) /
                           units.length;
  if (auto* sides = std::get_if<particles::SideVelocities>(&fluid.boundary))
    for (auto& side : *sides) {
      for (auto& component : side.value) component /= units.length;
      for (auto& piece : side.pieces.pieces)
        for (auto& component : piece.value) component /= units.length;
    }
  return fluid;
}

particles::Domain in_units(particles::Domain domain, const SolverUnits& units) {
  if (auto* disc = std::get_if<particles::DiscDomain>(&domain)) {
    change_place(disc->centre, units);
    disc->radius /= units.length;
  } else if (auto* box = std::get_if<particles::BoxDomain>(&domain)) {
    for (auto* corner : {&box->from, &box->to}) change_place(*corner, units);
  } else if (auto* cylinder = std::get_if<particles::CylinderDomain>(&domain)) {
    cylinder->radius /= units.length;
    cylinder->height /= units.length;
  }
  return domain;
}

std::vector<double> in_units(std::span<const double> lengths, const SolverUnits& units) {
  std::vector<double> scaled(lengths.begin(), lengths.end());
  for (auto& length : scaled) length /= units.length;
  return scaled;
}

std::vector<particles::Shape> in_units(std::span<const particles::Shape> shapes,
                                       const SolverUnits& units) {
  std::vector<particles::Shape> scaled;
  for (const auto& shape : shapes) scaled.push_back(shape.scaled(1 / units.length));
  return scaled;
}

std::vector<double> places_in_units(std::span<const double> places, int dimension,
                                    const SolverUnits& units) {
  assert(dimension == 1 || dimension == 2);
  if (dimension == 1) return in_units(places, units);
  std::vector<double> scaled(places.begin(), places.end());
  for (std::size_t i = 0; i < scaled.size(); ++i)
    scaled[i] = (scaled[i] - units.origin[i % 2]) / units.length;
  return scaled;
}

}  // namespace viscontact::freefem_flow
