// Spheres in a viscous fluid that is not resolved: each has its Stokes drag, and close pairs exert
// lubrication forces on each other; `[lubrication]` of a case, docs/physics.md (9.1).
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "viscontact/particles/values/piecewise_constant.hpp"
#include "viscontact/particles/values/vector.hpp"

namespace viscontact::particles {

/// Which resistances a pair of close spheres has to their motions relative to the flow.
enum class PairTerms : std::uint8_t {
  /// Those of two spheres in unbounded fluid, exact at every gap and ratio of radii.
  kTables,
  /// The terms 1/q and ln(1/q) (Jeffrey & Onishi 1984; Jeffrey 1992), with the gap q increased by
  /// `regularisation`.
  kNearContact,
  kNone,  ///< drag and contact alone
};

/// Repulsive force between two spheres, amplitude r_i r_j/(r_i + r_j) exp(-q/length) along the
/// normal, where q is the gap (Mari et al. 2014).
struct Repulsion {
  double amplitude = 0;  ///< [M/T^2]
  double length = 0;     ///< [L], > 0
};

/// Lengths named "in mean radii" are multiples of the mean radius of the pair.
struct PairLubrication {
  double viscosity = 0;  ///< [M/(L T)], > 0
  PairTerms pairs = PairTerms::kTables;
  double range = 0.5;         ///< largest gap of a pair, in mean radii, > 0
  double regularisation = 0;  ///< delta, in mean radii, >= 0
  double drag = 1;            ///< multiple of the Stokes drag of the single spheres, > 0
  /// du_i/dx_j of the undisturbed flow in row i and column j [1/T], without trace. With a stress it
  /// is the flow of rate 1, and the rate is a result.
  std::array<Vector, 3> gradient{};
  /// Factor on the gradient in component 0 [1], such as 1 and then -1 for a shear flow that reverses;
  /// without pieces it is 1 at all times.
  PiecewiseConstant rate_factor{};
  /// If it is given, the mean shear stress [M/(L T^2)] of the suspension, component xy.
  std::optional<double> stress;
  /// Displacement along x of the image of a sphere across the period y at the start [L].
  double offset = 0;
  double roughness = 0;  ///< gap at which solids touch, in mean radii, >= 0
  std::optional<Repulsion> repulsion;
};

}  // namespace viscontact::particles
