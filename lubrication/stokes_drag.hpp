// Stokes' drag of a sphere in an unbounded fluid. A drag divided by it is the drag factor.
#pragma once

#include <cassert>
#include <numbers>

namespace viscontact::lubrication {

/// Stokes' resistance 6 pi mu r [M/T] of a sphere of radius r [L] > 0 in an unbounded fluid of
/// viscosity mu [M/(L T)] > 0 (Stokes 1851).
inline double stokes_resistance(double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  return 6 * std::numbers::pi * viscosity * radius;
}

}  // namespace viscontact::lubrication
