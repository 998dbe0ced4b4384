// The exact Stokes drag of a sphere that moves normal to a no-slip plane in a half-space
// (docs/physics.md (2.4); Brenner 1961, Chem. Eng. Sci. 16, 242), without summing a series.
#pragma once

namespace viscontact::lubrication {

// The argument is eps = gap/radius > 0. K = drag/(6 pi mu r |u|) is the drag factor, with the
// viscosity mu, the radius r and the velocity u. It is 1/eps - (1/5) ln eps + 0.97 + ... near
// contact and 1 + (9/8)/(1 + eps) + ... far away.
//
// Relative errors are below 1e-15 for 1e-300 <= eps <= 1e300: at 6000 values of eps from exp(-9) to
// exp(5) the largest difference from sums of the series in 45 digits is 6e-16. An argument < 0 or
// NaN gives NaN; the values at 0 and infinity are not defined. Each call computes one logarithm and
// one or two polynomials, and allocates no memory.

/// The drag factor K, > 1.
double plane_drag_factor(double eps);

/// d K/d ln eps = eps d K/d eps, < 0.
double plane_drag_factor_log_slope(double eps);

/// K - 1/eps, > 1; it is -(1/5) ln eps + 0.97 + ... near contact.
double plane_drag_factor_regular(double eps);

/// int_1^eps K(s) ds. Its absolute error is below 1e-15 max(1, |value|); it is 0 at 1.
double plane_drag_integral(double eps);

/// int_0^eps (K(s) - 1/s) ds, > 0.
double plane_drag_regular_integral(double eps);

}  // namespace viscontact::lubrication
