// A fit for a sphere of another radius in a fluid of another viscosity. Stokes flow has no length
// of its own: the force at the gap q depends on q/r alone, in units of mu r u. Lengths, masses and
// times are in the units of the fit before, and in those of the case afterwards, so that a fit in
// units of the radius serves a case in SI units. simulate, sweep, rolling and export use it.
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
/// velocity, and 3 for a torque per angular velocity. Each term is a power of q, or such a power
/// times ln q (terms.hpp), which becomes a sum of both: ln(q r/r') = ln q - ln(r'/r). A term that
/// the fit lacks is added for this. Interval, theory's coefficient, errors, and lengths in the
/// words for geometry and container are scaled, too. If both radii are equal up to rounding, only
/// the factor mu'/mu is applied, and if it is 1, nothing changes.
Fit scaled_to(Fit fit, double viscosity, double radius, int power = 1);

/// The factor of a term's coefficient in scaled_to() without (mu'/mu) (r'/r)^power: the term at the
/// gap 1/`ratio`, where `ratio` is r'/r, or for a power times ln q that of the power.
double scale_of_term(std::string_view term, double ratio);

/// Words such as "sphere, radius 2, velocity_ratio 0" with all lengths multiplied by `factor`:
/// numbers behind a name that does not end in "_ratio".
std::string with_lengths_scaled(const std::string& words, double factor);

/// True if both texts have the same words and numbers that are equal up to rounding.
bool same_words(const std::string& one, const std::string& other);

}  // namespace viscontact::lubrication
