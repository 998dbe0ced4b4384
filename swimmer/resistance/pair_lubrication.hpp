// The lubrication between two spheres that approach each other along their line of centres: the
// singular part of a fit of resistances (resistance_fit.hpp). Lengths are in any one unit. A change
// must keep the formula, because fit files contain only the rest.
#pragma once

#include <Eigen/Core>
#include <span>

namespace viscontact::swimmer {

/// The most terms of pair_lubrication.
inline constexpr int kLubricationTerms = 3;

/// The singular part of the resistance of two spheres, radii a and b [L] > 0 and surfaces at the
/// distance gap [L] > 0, against a change of their distance, over the viscosity [L]:
///
///   6 pi a [ g1/xi + g2 ln(1 + 1/xi) + g3 xi ln(1 + 1/xi) ],   xi = 2 gap/(a + b),
///
/// with g1, g2, g3 of Jeffrey & Onishi 1984 (J. Fluid Mech. 139, 261, equation (3.17) for X11A).
/// Their ln(1/xi) is replaced by ln(1 + 1/xi), which has the same singularity and stays positive.
/// The value is symmetric in a and b. The first `terms` of the three are added, 0 to
/// kLubricationTerms.
double pair_lubrication(double a, double b, double gap, int terms);

/// The resistance matrix over the viscosity [L] of a line of spheres of which only neighbours
/// resist a change of their gap, by pair_lubrication(). `radii` and `gaps` are in [L]; `gaps` has
/// one element less than `radii`. The matrix is positive semidefinite.
Eigen::MatrixXd lubrication_matrix(std::span<const double> radii, std::span<const double> gaps,
                                   int terms);

/// d pair_lubrication / d gap [1].
double pair_lubrication_slope(double a, double b, double gap, int terms);

}  // namespace viscontact::swimmer
