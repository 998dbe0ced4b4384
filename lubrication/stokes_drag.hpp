// The drag of a sphere in an unbounded fluid, by which drag factors in tables and fits are divided.
// Nothing is checked or thrown. Used by lubrication/, freefem_axi/, fitting/ and report/. A change
// must keep the value, because published tables contain these factors.
#pragma once

#include <numbers>

namespace viscontact::lubrication {

/// Stokes' resistance 6 pi mu r [M/T] of a sphere of radius r [L] > 0 in an unbounded fluid of
/// viscosity mu [M/(L T)] > 0 (Stokes 1851).
inline double stokes_resistance(double viscosity, double radius) {
  return 6 * std::numbers::pi * viscosity * radius;
}

}  // namespace viscontact::lubrication
