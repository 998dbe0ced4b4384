// The units and the origin of places with which FreeFEM computes.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/setting/fluid.hpp"

namespace viscontact::freefem_flow {

/// The units in which FreeFEM computes: the powers of 2, whose scaling has no rounding error, with
/// which the radius of the smallest particle or membrane, and the viscosity, become numbers between
/// 0.7 and 1.5. The unit of time is that of the case. Places are relative to `origin`, because
/// FreeFEM makes no meshes of scenes whose coordinates are much larger than their sizes.
struct SolverUnits {
  double length = 1;               ///< [L], > 0
  double viscosity = 1;            ///< [M/(L T)], > 0
  std::array<double, 2> origin{};  ///< the place in the case [L] at which FreeFEM's origin is

  /// The place in the case [L] of the point `x` in these units.
  std::array<double, 2> in_case(const std::array<double, 2>& x) const {
    return {x[0] * length + origin[0], x[1] * length + origin[1]};
  }
};

/// For the smallest of `radii`, or for the size of the domain if there are none. The origin is
/// distant_corner() of the domain.
SolverUnits solver_units(const particles::Fluid& fluid, const particles::Domain& domain,
                         std::span<const double> radii);

/// Lengths, masses and what depends on them, divided by the units of the solver, and places
/// relative to its origin. The penalty, the viscosity ratios, times, angles and rates [1/T] stay.
particles::Fluid in_units(particles::Fluid fluid, const SolverUnits& units);
particles::Domain in_units(particles::Domain domain, const SolverUnits& units);
std::vector<double> in_units(std::span<const double> lengths, const SolverUnits& units);
std::vector<particles::Shape> in_units(std::span<const particles::Shape> shapes,
                                       const SolverUnits& units);

/// `places` has `dimension` numbers for each particle: x and y, or z on the axis of a cylinder.
std::vector<double> places_in_units(std::span<const double> places, int dimension,
                                    const SolverUnits& units);

}  // namespace viscontact::freefem_flow
