// The value gamma_min of a pair at which its film gives way to solid contact, docs/physics.md
// (5.5), after Maury 2007 and Lefebvre 2008. Units are any one consistent system.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace viscontact::particles {

/// Solid contact of rough particles, docs/physics.md (4.6) and (5.5). Either gamma_min is set, or
/// both viscosity and roughness, or nothing (smooth particles without solid contact). gamma_min = 0
/// leaves no film, so that contact is plain inelastic contact.
struct ContactLaw {
  std::optional<double> gamma_min;  ///< of every pair [M L/T], <= 0
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  /// Height s of the roughness of each particle and plane [L], > 0.
  std::optional<double> roughness;

  /// k_ij = 6 pi mu r_eff^2 [M L/T] with r_eff = r_i r_j/(r_i + r_j); r_j is infinite for a plane.
  /// Discs count as spheres whose centres stay in a plane. Needs `viscosity`.
  double leading_coefficient(double r_i, double r_j) const {
    const double r = effective_radius(r_i, r_j);
    return 6 * std::numbers::pi * *viscosity * r * r;
  }

  /// gamma_min,ij = k_ij ln(2 s/r_eff) [M L/T], at most 0; minus infinity for smooth particles.
  double lower_bound(double r_i, double r_j) const {
    if (gamma_min) return *gamma_min;
    if (!viscosity) return -std::numeric_limits<double>::infinity();
    return std::min(
        0.0, leading_coefficient(r_i, r_j) * std::log(2 * *roughness / effective_radius(r_i, r_j)));
  }

  static double effective_radius(double r_i, double r_j) {
    return std::isinf(r_j) ? r_i : r_i / (1 + r_i / r_j);
  }
};

}  // namespace viscontact::particles
