// The resistance of the film between two bodies that approach each other: its integral over the
// gap, and the gap from the integral (docs/physics.md (6.8)).
#pragma once

namespace viscontact::lubrication {

// The resistance R is the force that one body exerts on the fluid, over the rate at which the gap
// closes, while the other body exerts the opposite force and the fluid is unbounded: the pair as a
// whole has no net force. Forces of contact are such a pair of forces, so that R is the resistance
// that the contact feels, however the pair moves as a whole. (With the neighbour held at rest the
// terms 1/q, ln q and q ln q are the same, and the rest is larger; next to a plane, and in a round
// wall at rest, there is no difference.)
//
// `radius` is that of the one body, `neighbour` that of the other one, infinite for a plane, or
// minus the radius of a round wall around the body. Lengths are in one unit [L], > 0. In a round
// wall gaps are at most the difference of the radii; larger ones count as this one. Results are in
// units of the viscosity.

/// r_eff = 1/(1/radius + 1/neighbour) [L]; two bodies have the same bits in either order.
inline double effective_radius(double radius, double neighbour) {
  return neighbour > 0 && neighbour < radius ? neighbour / (1 + neighbour / radius)
                                             : radius / (1 + radius / neighbour);
}

/// The integral of R over the gap, from `from` to `to` [L^2]; < 0 if to < from. At a plane it is
/// plane_drag_integral(). Otherwise what R has beyond its terms 1/q, ln q and q ln q is interpolated
/// between exact solutions (Stimson & Jeffery 1926; Maude 1961). The relative error is below 1e-5
/// for gaps up to r_eff, 1e-4 up to 10 r_eff, and 1e-3 at any gap.
double sphere_squeeze_integral(double radius, double neighbour, double from, double to);

/// The same for discs, which are cylinders, per length [L]. With the gap q, R = 4 pi mu/(s - tanh
/// s), cosh s = 1 + q/r_eff + q^2/(2 radius neighbour), exactly: 3 sqrt(2) pi mu (r_eff/q)^(3/2) to
/// leading order. The stream function is (A cosh 2 a + B + C sinh 2 a + D a) sin b in bipolar
/// coordinates (a, b), and s the difference of the values of a on the two circles; at a plane it is
/// the result of Jeffrey & Onishi 1981 (Q. J. Mech. Appl. Math. 34, 129). The relative error is
/// below 1e-12.
double disc_squeeze_integral(double radius, double neighbour, double from, double to);

using SqueezeIntegral = double (*)(double radius, double neighbour, double from, double to);

/// The gap q <= `from` from which `integral` up to `from` is `value` >= 0, to rounding errors; at
/// least exp(-700).
double gap_of_squeeze(SqueezeIntegral integral, double radius, double neighbour, double from,
                      double value);

}  // namespace viscontact::lubrication
