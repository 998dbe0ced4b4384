// Numbers without dimension that say whether a model of Stokes flow or of viscous contact holds,
// and the sentences that warn if it does not.
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <string_view>

namespace viscontact::lubrication {

/// Re = 2 r rho_f u/mu of a sphere of radius r [L] at the speed u [L/T], in a fluid of density
/// rho_f [M/L^3] and viscosity mu [M/(L T)] > 0.
inline double reynolds_number(double density, double radius, double speed, double viscosity) {
  assert(viscosity > 0);
  return 2 * radius * density * speed / viscosity;
}

/// St = m u/(6 pi mu r^2) of a sphere of mass m [M].
double stokes_number(double mass, double radius, double speed, double viscosity);

/// The drag of a sphere far from walls over Stokes' drag, 1 + 0.15 Re^0.687 (Schiller & Naumann
/// 1933), for Re up to 800.
double drag_over_stokes(double reynolds);

/// Stokes' drag is 3 % too small there.
inline constexpr double kLargestReynolds = 0.1;

/// Says by how much Stokes' drag is too small if the Reynolds number is above kLargestReynolds.
std::optional<std::string> reynolds_warning(double reynolds);

/// The smallest m u/|gamma| without a warning, with the momentum m u of the landing and the impulse
/// |gamma| that the film absorbs. Viscous contact neglects the drag before contact. Where a
/// constant force presses a sphere from the gap r onto a roughness of 1e-2 to 1e-4 r, the solids
/// touch 18 to 10 % too early for all m u/|gamma| below 0.5, 6 % at 3 and 2 % at 10
/// (docs/studies.md, "Regimes"). Below 0.1 the sphere's inertia changes nothing by more than 0.02
/// %.
inline constexpr double kSmallestFilmStokes = 0.1;

/// A sentence if `film_stokes` is below kSmallestFilmStokes, which ends with `remedy`.
std::optional<std::string> film_warning(double film_stokes, std::string_view remedy);

}  // namespace viscontact::lubrication
