// The gluey film between two surfaces, and the value gamma_min at which it gives way to solid
// contact (Maury 2007, Lefebvre 2008): docs/physics.md (5.2), (5.5) and (6.8). Lengths, masses and
// times are in any consistent units. Solvers take the bounds of a contact's impulse from here; a
// simulation changes gamma by absorb() alone, and a change must keep that. Nothing is checked or
// thrown. Used by contact_laws.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The film between two surfaces that approach each other: its resistance R to leading order at
/// small gaps q, by Reynolds' equation. mu is the viscosity, and r_eff the effective radius
/// (FilmLaw::effective_radius()).
enum class FilmShape {
  /// Spheres: R = 6 pi mu r_eff^2/q [M/T]. Discs without a fluid count as spheres in a plane.
  kSpheres,
  /// Discs in the plane of a fluid, which are cylinders: R = 3 sqrt(2) pi mu (r_eff/q)^(3/2)
  /// [M/(L T)] per length (Jeffrey & Onishi 1981).
  kDiscs,
};

/// Integral of the resistance R over the gap, between the gaps `from` and `to` [L]: < 0 if the gap
/// closes. It is Gamma(to) - Gamma(from) for a primitive Gamma of R; for spheres [M L/T], for discs
/// [M/T], which is an impulse per length. Viscosity [M/(L T)], r_eff [L] and both gaps are > 0.
inline double impulse_of_film(FilmShape shape, double viscosity, double r_eff, double from,
                              double to) {
  using std::numbers::pi;
  if (shape == FilmShape::kSpheres) return 6 * pi * viscosity * r_eff * r_eff * std::log(to / from);
  return 6 * std::numbers::sqrt2 * pi * viscosity * r_eff *
         (std::sqrt(r_eff / from) - std::sqrt(r_eff / to));
}

/// The film obeys
///
///     dgamma/dt = -lambda,   gamma_min <= gamma <= 0,   p = h lambda >= gamma^n,
///
/// where lambda is the force of the contact, > 0 where it pushes, p its impulse in a step of length
/// h, and gamma^n the value of gamma before the step.
/// Either gamma_min is set, or both viscosity and roughness, or nothing (smooth particles without
/// solid contact). gamma_min = 0 leaves no film, so that contact is plain inelastic contact.
struct FilmLaw {
  std::optional<double> gamma_min;  ///< of every pair [M L/T], of discs in a fluid [M/T], <= 0
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  /// Height s of the roughness of each particle and plane [L], > 0.
  std::optional<double> roughness;
  FilmShape shape = FilmShape::kSpheres;  ///< of the resistance; kDiscs in the plane of a fluid
  /// The gap at which the film begins [L], > 0, the one reference length of gamma and gamma_min.
  /// Without a value it is r_eff. In a fluid it is the gap D_c down to which the flow is computed.
  std::optional<double> begins_at{};

  /// r_i r_j/(r_i + r_j) [L]. r_j is infinite for a plane, and minus the radius of a round wall
  /// around the particle.
  static double effective_radius(double r_i, double r_j) { return r_i / (1 + r_i / r_j); }

  /// gamma_min,ij <= 0, in the unit of gamma_min; minus infinity for smooth particles. With the
  /// roughness s it is impulse_of_film() from the gap at which the film begins to 2 s, and 0 if 2 s
  /// is not below that gap. The radii are those of effective_radius().
  double lowest_gamma(double r_i, double r_j) const {
    if (gamma_min) return *gamma_min;
    if (!viscosity) return -std::numeric_limits<double>::infinity();
    const double r_eff = effective_radius(r_i, r_j);
    return std::min(
        0.0, impulse_of_film(shape, *viscosity, r_eff, begins_at.value_or(r_eff), 2 * *roughness));
  }

  /// The film takes up the impulse p = h lambda of a pair (Pair::impulse): gamma^{n+1} = gamma^n -
  /// p, within [`lowest`, 0]. The solids take the rest. A gamma that is 0 within the rounding error
  /// of this difference is set to 0: the film has given back all that it had absorbed.
  /// `impulse_error` >= 0 is the residual of the impulse; all are impulses, in the unit of gamma.
  static void absorb(Pair& pair, double impulse_error, double lowest) {
    const double gamma = pair.gamma - pair.impulse;
    const double rounding =
        std::numeric_limits<double>::epsilon() * (std::abs(pair.gamma) + std::abs(pair.impulse));
    const double error = pair.gamma_error + impulse_error + rounding;
    const bool spent = gamma >= -rounding;
    const double bound = spent ? 0 : lowest;
    pair.gamma = spent ? 0.0 : std::max(gamma, bound);
    pair.gamma_error = spent || pair.gamma == bound ? 0 : error;
  }
};

}  // namespace viscontact::particles
