// Exact Stokes drag of a sphere that moves normally to a no-slip plane in an unbounded fluid. Tests
// compare tabulations with it; it shares no code with lubrication/plane_drag.hpp.
#pragma once

namespace viscontact {

/// Drag factor lambda = drag / (6 pi mu r |u|) of a sphere of radius r and velocity u in a fluid of
/// viscosity mu, at epsilon = gap / r, 1e-6 <= epsilon <= 1e3. The relative error is below 1e-13.
/// Brenner 1961 (Chem. Eng. Sci. 16, 242), with cosh(alpha) = 1 + epsilon:
///
///     lambda = (4/3) sinh(alpha) sum_{n>=1} n(n+1)/((2n-1)(2n+3)) [ N_n / D_n - 1 ],
///     N_n = 2 sinh((2n+1) alpha) + (2n+1) sinh(2 alpha),   D_n = 4 sinh^2((n+1/2) alpha) -
///     (2n+1)^2 sinh^2(alpha).
double brenner_drag_factor(double epsilon);

}  // namespace viscontact
