// Stokes' drag of a sphere in an unbounded fluid. A drag divided by it is the drag factor in tables
// and fits. Units are any consistent ones. Nothing is checked or thrown: arguments of other signs
// or NaN give a number without meaning. lubrication/, freefem_axi/, fitting/ and report/ use it. A
// change must keep the value, because published tables contain drag factors.
#pragma once

#include <numbers>

namespace viscontact::lubrication {

/// Stokes' resistance 6 pi mu r [M/T] of a sphere of radius r [L] > 0 in an unbounded fluid of
/// viscosity mu [M/(L T)] > 0 (Stokes 1851).
inline double stokes_resistance(double viscosity, double radius) {
  return 6 * std::numbers::pi * viscosity * radius;
}

}  // namespace viscontact::lubrication
