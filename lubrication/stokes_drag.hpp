// The drag of a sphere in an unbounded fluid, the unit in which tables, fits and limits give other
// drags. Nothing is checked or thrown. A change must keep the value, because factors in published
// tables refer to it.
#pragma once

#include <numbers>

namespace viscontact::lubrication {

/// Stokes' resistance 6 pi mu r [M/T] of a sphere of radius r [L] > 0 in an unbounded fluid of
/// viscosity mu [M/(L T)] > 0 (Stokes 1851).
inline double stokes_resistance(double viscosity, double radius) {
  return 6 * std::numbers::pi * viscosity * radius;
}

}  // namespace viscontact::lubrication
