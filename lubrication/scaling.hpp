// The fit for a sphere of another radius r' in a fluid of another viscosity mu'. In Stokes flow the
// force divided by mu r u, with the velocity u, depends on the gap q only by q/r.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/lubrication/fit.hpp"

namespace viscontact::lubrication {

/// The fit for another radius r' [L] > 0 and viscosity mu' [M/(L T)] > 0, which may be in other
/// units than before,
///
///     F'(q) = (mu'/mu) (r'/r)^power F(q r/r'),
///
/// with power = 1 for a force per velocity, 2 for a force per angular velocity or a torque per
/// velocity, and 3 for a torque per angular velocity. A term q^n ln q becomes a sum of the terms
/// q^n ln q and q^n, because ln(q r/r') = ln q - ln(r'/r); q^n is added to the fit if it lacks it.
/// The interval of gaps, the leading coefficient, errors, gaps in the diagnostics, and lengths in
/// the words for geometry and container are scaled, too. If both radii are equal up to rounding,
/// only the factor mu'/mu is applied. For a fit of kExactPlane the result is exact_plane_fit().
/// Throws Error(kBadInput) for a term that is not in terms_beside_walls().
Fit scaled_to(Fit fit, double viscosity, double radius, int power = 1);

/// The factor ratio^-n [1] by which scaled_to() multiplies the coefficient of a term q^n or q^n ln
/// q, besides (mu'/mu) (r'/r)^power, with `ratio` = r'/r > 0.
double scale_of_term(std::string_view term, double ratio);

/// Words such as "sphere, radius 2, velocity_ratio 0" with all lengths multiplied by `factor` [1].
/// Each number after a word that does not end in "_ratio" counts as a length; a number at the
/// beginning does not. Words of the result have one blank between them.
std::string with_lengths_scaled(const std::string& words, double factor);

/// True if both texts have equal words in the same order, where two numbers also count as equal if
/// they differ by rounding only.
bool same_words(const std::string& one, const std::string& other);

}  // namespace viscontact::lubrication
