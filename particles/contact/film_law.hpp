// The law of the viscous film between two surfaces (Maury 2007, Lefebvre 2008), docs/physics.md
// (5.2), (5.5) and (6.8).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "viscontact/lubrication/pairs/squeeze_film.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// The bodies whose exact resistance R to an approach, force over velocity, a film has at every gap
/// (lubrication/pairs/squeeze_film.hpp). The effective radius is r_eff [L].
enum class FilmShape {
  /// R = 6 pi mu r_eff^2/q + ... [M/T]. Without a fluid discs also have this film, because they are
  /// spheres whose centres stay in a plane.
  kSpheres,
  /// Cylinders: R = 3 sqrt(2) pi mu (r_eff/q)^(3/2) + ... per length [M/(L T)].
  kDiscs,
};

inline lubrication::SqueezeIntegral squeeze_integral(FilmShape shape) {
  return shape == FilmShape::kSpheres ? lubrication::sphere_squeeze_integral
                                      : lubrication::disc_squeeze_integral;
}

/// Integral of the resistance R over the gap, from `from` to `to` > 0 [L]: an impulse [M L/T], of
/// kDiscs per length [M/T]; < 0 if to < from. `r_j` is that of FilmLaw::lowest_gamma().
inline double impulse_of_film(FilmShape shape, double viscosity, double r_i, double r_j,
                              double from, double to) {
  assert(viscosity > 0);
  return viscosity * squeeze_integral(shape)(r_i, r_j, from, to);
}

/// gamma <= 0 is minus the impulse that the film has absorbed while it was pressed; the film holds
/// the surfaces together until a pull has given this impulse back. At gamma_min the solids touch:
///
///     dgamma/dt = -lambda,   gamma_min <= gamma <= 0,   p = h lambda >= gamma^n,
///
/// lambda is the force of the contact, > 0 where it pushes, p its impulse in a step of length h,
/// and gamma^n the value of gamma before the step. Either gamma_min is set; or viscosity and
/// roughness are set, from which gamma_min follows; or none of the three is set, and the particles
/// are smooth, so that their solids never touch. With gamma_min = 0 there is no film, and contacts
/// are plain inelastic contacts.
struct FilmLaw {
  std::optional<double> gamma_min;  ///< of every pair, <= 0 [M L/T]; of discs in a fluid [M/T]
  std::optional<double> viscosity;  ///< mu [M/(L T)], > 0
  /// Height s of the roughness of each particle and plane [L], > 0.
  std::optional<double> roughness;
  FilmShape shape = FilmShape::kSpheres;  ///< kDiscs in the plane of a fluid
  /// The gap at which gamma begins to fall from 0 [L]; without a value r_eff. In a fluid it is the
  /// gap at which contact is made; at larger gaps the computed flow acts as the film.
  std::optional<double> begins_at{};

  /// gamma_min of a pair with these radii; minus infinity for smooth particles. `r_j` is the radius
  /// of another particle, infinite for a plane, or minus the radius of a round wall around the
  /// particle of radius `r_i`. With the roughness s it is impulse_of_film() from the gap at which
  /// the film begins to the gap 2 s, at which two rough surfaces touch, or 0 if 2 s is the larger
  /// gap.
  double lowest_gamma(double r_i, double r_j) const {
    if (gamma_min) return *gamma_min;
    if (!viscosity) return -std::numeric_limits<double>::infinity();
    assert(roughness);
    if (!is_between(r_i, r_j)) return 0;
    return impulse_of_film(shape, *viscosity, r_i, r_j, begin_of(r_i, r_j), 2 * *roughness);
  }

  /// Whether lowest_gamma() is below 0.
  bool is_between(double r_i, double r_j) const {
    if (gamma_min) return *gamma_min < 0;
    if (!viscosity) return true;
    assert(roughness);
    // A round wall leaves at most the difference of the radii.
    const double largest = r_j < 0 ? -r_j - r_i : std::numeric_limits<double>::infinity();
    return 2 * *roughness < std::min(begin_of(r_i, r_j), largest);
  }

  /// The gap at which the film of a pair begins [L].
  double begin_of(double r_i, double r_j) const {
    return begins_at ? *begins_at : std::abs(lubrication::effective_radius(r_i, r_j));
  }

  /// The film takes up the impulse p = Pair::impulse: gamma becomes gamma - p, within [`lowest`, 0]
  /// with `lowest` = lowest_gamma(), and the solids take the rest. A result that is 0 within its
  /// rounding error is set to 0, because the film has then given back all that it had absorbed.
  /// Also updates Pair::gamma_error; `impulse_error` is the residual of p.
  static void absorb(Pair& pair, double impulse_error, double lowest) {
    assert(lowest <= 0);
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
