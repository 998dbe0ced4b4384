// The law of the viscous film between two surfaces in contact (Maury 2007, Lefebvre 2008):
// docs/physics.md (5.2), (5.5) and (6.8). gamma <= 0 is minus the impulse that the film has
// absorbed while it was pressed; the film holds the surfaces together until a pull has given this
// impulse back. At gamma = gamma_min the solids touch. Lengths [L], masses [M] and times [T] are in
// any consistent units. Nothing is checked or thrown. All of particles/ uses the law through
// contact_laws.hpp. A simulation must change gamma only by absorb(), except in a blow of solids
// that rebound (impacts/).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The formula for the resistance R of a film, which is the force divided by the velocity of
/// approach. R is taken to leading order at small gaps q [L], by Reynolds' equation. mu [M/(L T)]
/// is the viscosity, and r_eff = r_i r_j/(r_i + r_j) [L] the effective radius of two surfaces with
/// the radii r_i and r_j.
enum class FilmShape {
  /// Spheres: R = 6 pi mu r_eff^2/q [M/T]. In a simulation without a fluid, discs also have this
  /// film, because they are spheres whose centres stay in a plane.
  kSpheres,
  /// Discs in a plane flow, which are cylinders: R = 3 sqrt(2) pi mu (r_eff/q)^(3/2) per length
  /// [M/(L T)] (Jeffrey & Onishi 1981).
  kDiscs,
};

/// Integral of the resistance R over the gap, from the gap `from` to the gap `to` [L]. It is an
/// impulse [M L/T] for kSpheres, an impulse per length [M/T] for kDiscs, and < 0 if to < from.
/// Viscosity [M/(L T)], r_eff [L] and both gaps must be > 0; otherwise the result may be infinite
/// or NaN.
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
/// h, and gamma^n the value of gamma before the step. There are three choices. Either gamma_min is
/// set; or both viscosity and roughness are set, from which gamma_min follows; or none of the three
/// is set, and the particles are smooth, so that their solids never touch. A viscosity without a
/// roughness is undefined behaviour. With gamma_min = 0 there is no film, and contacts are plain
/// inelastic contacts.
struct FilmLaw {
  std::optional<double> gamma_min;  ///< of every pair, <= 0 [M L/T]; of discs in a fluid [M/T]
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  /// Height s of the roughness of each particle and plane [L], > 0.
  std::optional<double> roughness;
  FilmShape shape = FilmShape::kSpheres;  ///< of the resistance; kDiscs in the plane of a fluid
  /// The gap at which gamma begins to fall from 0 [L], > 0. Without a value it is r_eff. In a fluid
  /// it is the gap at which contact is made; at larger gaps the computed flow acts as the film.
  std::optional<double> begins_at{};

  /// The effective radius r_eff = r_i r_j/(r_i + r_j) [L], with the radius `r_i` > 0 of a particle.
  /// `r_j` is the radius > 0 of another particle, infinite for a plane, or minus the radius of a
  /// round wall around the particle. If this wall has the radius of the particle, the result is
  /// infinite.
  static double effective_radius(double r_i, double r_j) { return r_i / (1 + r_i / r_j); }

  /// gamma_min of a pair, <= 0, in the unit of the member gamma_min; minus infinity for smooth
  /// particles. With the roughness s it is impulse_of_film() from the gap at which the film begins
  /// to the gap 2 s, at which two rough surfaces touch, or 0 if 2 s is the larger gap. The radii
  /// are those of effective_radius().
  double lowest_gamma(double r_i, double r_j) const {
    if (gamma_min) return *gamma_min;
    if (!viscosity) return -std::numeric_limits<double>::infinity();
    const double r_eff = effective_radius(r_i, r_j);
    return std::min(
        0.0, impulse_of_film(shape, *viscosity, r_eff, begins_at.value_or(r_eff), 2 * *roughness));
  }

  /// Updates Pair::gamma after a step: the film takes up the impulse p = Pair::impulse, so that
  /// gamma becomes gamma - p, but stays within [`lowest`, 0], where `lowest` is lowest_gamma(). The
  /// solids take the rest of p. A result that is 0 within its rounding error is set to 0, because
  /// the film has then given back all that it had absorbed. The function also updates
  /// Pair::gamma_error, an estimate of the error of gamma. `impulse_error` >= 0 is the residual of
  /// p. All these numbers are in the unit of gamma.
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
