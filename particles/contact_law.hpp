// When the film between two particles gives way to the solids.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace viscontact::particles {

/// Solid contact of rough particles (Vinogradova & Yakubov 2006; physics.md, sections 4 and 5). One of: gamma_min; viscosity and roughness; neither
/// (smooth: no solid contact). gamma_min = 0 leaves no film at all: inelastic contact.
struct ContactLaw {
  std::optional<double> gamma_min;  ///< of every pair [M L/T], <= 0
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  std::optional<double> roughness;  ///< height s of each particle's and plane's [L], > 0

  /// k_ij = 6 pi mu r_eff^2 [M L/T], r_eff = r_i r_j/(r_i + r_j); r_j infinite for a plane. Discs are spheres whose centres stay in a plane.
  double leading_coefficient(double r_i, double r_j) const {
    const double r = effective_radius(r_i, r_j);
    return 6 * std::numbers::pi * *viscosity * r * r;
  }

  /// gamma_min,ij = k_ij ln((s_i + s_j)/r_eff) [M L/T], at most 0; -infinity for smooth ones.
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
