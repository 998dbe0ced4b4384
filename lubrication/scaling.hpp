// Makes, from a fit of the force on a sphere of radius r in a fluid of viscosity mu, the fit for
// another radius r' and viscosity mu'. In Stokes flow the force divided by mu r u, with the
// velocity u, depends on the gap q only by q/r. Lengths, masses and times may be in other units
// afterwards than before: a fit in units of the radius serves a case in SI units. A fit with a term
// that is not in all_terms() throws Error(kBadInput). Radii and viscosities are not checked. Used
// by case_file/, motions/, swimmer/, the command `export` and the Python module. A change must keep
// all bits of a fit whose radius and viscosity do not change.
#pragma once

#include <string>
#include <string_view>

#include "viscontact/lubrication/fit.hpp"

namespace viscontact::lubrication {

/// The fit for another radius r' [L] > 0 and viscosity mu' [M/(L T)] > 0,
///
///     F'(q) = (mu'/mu) (r'/r)^power F(q r/r'),
///
/// with power = 1 for a force per velocity, 2 for a force per angular velocity or a torque per
/// velocity, and 3 for a torque per angular velocity. A term q^n ln q becomes a sum of the terms
/// q^n ln q and q^n, because ln(q r/r') = ln q - ln(r'/r); q^n is added to the fit if it lacks it.
/// The interval of gaps, the leading coefficient, errors, gaps in the diagnostics, and lengths in
/// the words for geometry and container are scaled, too. If both radii are equal up to rounding,
/// only the factor mu'/mu is applied. For a fit of kExactPlane the result is exact_plane_fit().
/// Throws Error(kBadInput) for a term that is not in all_terms(). That mu' and r' are > 0 is not
/// checked: the result may then be infinite or NaN.
Fit scaled_to(Fit fit, double viscosity, double radius, int power = 1);

/// The factor by which scaled_to() multiplies the coefficient of a term q^n or q^n ln q, besides
/// (mu'/mu) (r'/r)^power. It is ratio^-n [1], with `ratio` = r'/r > 0 (not checked). Throws
/// Error(kBadInput) for a name that is not in all_terms().
double scale_of_term(std::string_view term, double ratio);

/// Words such as "sphere, radius 2, velocity_ratio 0" with all lengths multiplied by `factor` [1].
/// Each number after a word that does not end in "_ratio" counts as a length; a number at the
/// beginning does not. Words of the result have one blank between them. Throws nothing.
std::string with_lengths_scaled(const std::string& words, double factor);

/// True if both texts have equal words in the same order, where two numbers also count as equal if
/// they differ by rounding only. Throws nothing.
bool same_words(const std::string& one, const std::string& other);

}  // namespace viscontact::lubrication
