// Exact Stokes drag of a sphere that moves normally to a no-slip plane in a half-space, fast and to
// round-off.
#pragma once

namespace viscontact {

// eps = gap / radius > 0, without dimension as is every value here.
// lambda = drag / (6 pi mu r |u|), Brenner 1961 (Chem. Eng. Sci. 16, 242): 1/eps - (1/5) ln eps +
// 0.97 + ... near contact, 1 + (9/8)/(1 + eps) + ... far away.
//
// Relative errors are below 1e-15 for 1e-300 <= eps <= 1e300 (6e-16 was the largest at 6000 gaps
// from exp(-9) to exp(5), against sums of 45 digits). Nothing is checked or thrown: eps < 0 and NaN
// give NaN, 0 and infinity what the arithmetic makes of them. No allocation; a logarithm and a
// polynomial each.

/// lambda, > 1.
double plane_drag_factor(double eps);

/// d lambda/d ln eps = eps d lambda/d eps, < 0.
double plane_drag_factor_log_slope(double eps);

/// lambda - 1/eps, > 1: what is left without the singular part, -(1/5) ln eps + 0.97 + ... near
/// contact.
double plane_drag_factor_regular(double eps);

/// int_1^eps lambda(s) ds, of the sign of ln eps. The error is below 1e-15 max(1, |value|): it is 0
/// at eps = 1.
double plane_drag_integral(double eps);

/// int_0^eps (lambda(s) - 1/s) ds, > 0.
double plane_drag_regular_integral(double eps);

}  // namespace viscontact
