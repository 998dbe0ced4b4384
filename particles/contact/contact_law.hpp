// The value gamma_min of a pair at which its film gives way to solid contact (Maury 2007, Lefebvre
// 2008): docs/physics.md (5.5) without a fluid and (6.8) in one. Units are any one consistent
// system.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace viscontact::particles {

/// The film between two surfaces that approach each other: its resistance R to leading order at
/// small gaps q, by Reynolds' equation.
enum class FilmShape {
  /// Spheres: R = 6 pi mu r_eff^2/q [M/T]. Discs without a fluid count as spheres whose centres
  /// stay in a plane.
  kSpheres,
  /// Discs in the plane of a fluid, which are cylinders: R = 3 sqrt(2) pi mu (r_eff/q)^(3/2)
  /// [M/(L T)] per length (Jeffrey & Onishi 1981).
  kDiscs,
};

/// Gamma(`to`) - Gamma(`from`), the integral of R over the gap: < 0 if the gap closes. For spheres
/// [M L/T], for discs [M/T], which is an impulse per length. Viscosity, r_eff and both gaps
/// are > 0.
inline double impulse_of_film(FilmShape shape, double viscosity, double r_eff, double from,
                              double to) {
  using std::numbers::pi;
  if (shape == FilmShape::kSpheres) return 6 * pi * viscosity * r_eff * r_eff * std::log(to / from);
  return 6 * std::numbers::sqrt2 * pi * viscosity * r_eff *
         (std::sqrt(r_eff / from) - std::sqrt(r_eff / to));
}

/// Solid contact of rough particles, docs/physics.md (4.6), (5.5) and (6.8). Either gamma_min is
/// set, or both viscosity and roughness, or nothing (smooth particles without solid contact).
/// gamma_min = 0 leaves no film, so that contact is plain inelastic contact.
struct ContactLaw {
  std::optional<double> gamma_min;  ///< of every pair [M L/T], of discs in a fluid [M/T], <= 0
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  /// Height s of the roughness of each particle and plane [L], > 0.
  std::optional<double> roughness;

  /// gamma_min,ij [M L/T] without a fluid, <= 0; minus infinity for smooth particles. The film
  /// begins at the gap r_eff: gamma_min,ij = k_ij ln(2 s/r_eff), k_ij = 6 pi mu r_eff^2. r_j is
  /// infinite for a plane.
  double lower_bound(double r_i, double r_j) const {
    return lower_bound_from(FilmShape::kSpheres, r_i, r_j, effective_radius(r_i, r_j));
  }

  /// gamma_min,ij in a fluid, <= 0; minus infinity for smooth particles. The flow is computed down
  /// to the gap `resolved` = D_c [L], > 0, and the film that gamma stands for begins there:
  /// gamma_min,ij = Gamma(2 s) - Gamma(D_c), 0 if 2 s >= D_c. r_j is infinite for a plane, and
  /// minus the radius of a round wall around the particle.
  double lower_bound_in_fluid(FilmShape shape, double r_i, double r_j, double resolved) const {
    return lower_bound_from(shape, r_i, r_j, resolved);
  }

  /// r_i r_j/(r_i + r_j) [L].
  static double effective_radius(double r_i, double r_j) { return r_i / (1 + r_i / r_j); }

 private:
  double lower_bound_from(FilmShape shape, double r_i, double r_j, double gap) const {
    if (gamma_min) return *gamma_min;
    if (!viscosity) return -std::numeric_limits<double>::infinity();
    return std::min(
        0.0, impulse_of_film(shape, *viscosity, effective_radius(r_i, r_j), gap, 2 * *roughness));
  }
};

}  // namespace viscontact::particles
