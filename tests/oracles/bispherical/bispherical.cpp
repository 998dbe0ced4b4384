// Sums the series of bispherical.hpp.
#include "tests/oracles/bispherical/bispherical.hpp"

#include <algorithm>
#include <cmath>

#include "tests/oracles/bispherical/bispherical_basis.hpp"

namespace viscontact {
namespace {

// The sphere is xi = alpha > 0, the second surface xi = xi2 < alpha: a sphere outside (xi2 < 0), a
// plane (0), a cavity around (xi2 > 0). With m = n + 1/2 and c half the distance of the poles, the
// stream function is
//
//     psi = (cosh xi - cos eta)^(-3/2) sum_{n>=1} U_n(xi) (P_{n-1} - P_{n+1})(cos eta),
//
// U_n in the span of exp(+-(m-1) xi), exp(+-(m+1) xi). A surface that moves at v asks for
// psi = -v rho^2/2 and the same normal derivative; rho^2/2 has the coefficients k_n w_n(xi),
//
//     k_n = c^2 n(n+1)/(sqrt(2) (2n+1)),   w_n = exp(-m |xi|) (m sinh|xi| + cosh xi)/(m^2 - 1).
//
// -w_n continued from xi > 0 to all xi is a uniform flow, without force on the sphere. Subtracting
// it leaves k_n G_n with a double zero at alpha: in s = alpha - xi,
//
//     G_n = 2 p S(s) + 2 q H(s)
//
// with the functions of bispherical_basis.hpp, p and q from two conditions at s = sigma =
// alpha - xi2, and drag factor =
//
//     (2/3) sinh(alpha) sum n(n+1) exp(-m alpha) [p sinh(alpha) - q (m sinh(alpha) + cosh(alpha))].
//
// Near contact, and for a far small second sphere, differences of these functions would lose all
// digits. They are written so that no numbers are subtracted that agree to leading order.

using Real = long double;

enum class Condition { kNoSlip, kShearFree };

struct Surface {
  Real xi;
  Condition condition = Condition::kNoSlip;
  Real velocity = 0;  ///< over the sphere's
};

/// p and q, each times twice the determinant, which has the factor exp(-m sigma); q has its sign
/// changed.
struct Solution {
  Real p, q;
};

/// From G and its derivative in xi at xi2.
Solution solve(const BisphericalBasis& at, Real m2, Real g, Real dg) {
  return {.p = m2 * g * at.s + dg * at.h, .q = dg * at.s + g * at.k};
}

/// Two spheres that move together: G = w_n continued from xi > 0, less w_n, all times
/// exp(-m beta)/2. That is (sinh(m beta) cosh(beta) - m cosh(m beta) sinh(beta))/m2.
Solution solve_together(const BisphericalBasis& at_sigma, Real m, Real alpha, Real beta) {
  const Real m2 = m * m - 1, x = m * beta;
  if (x < 1) {
    const BisphericalBasis at_beta(m, beta);
    return solve(at_sigma, m2, -at_beta.h / m2, at_beta.s);
  }
  // Here the two products in p, and those in q, agree to exp(-2 beta): the same numbers by the
  // addition theorems.
  const Real sigma = alpha + beta, decay = std::exp(-2 * x);
  const Real sinh_x = -std::expm1(-2 * x) / 2;
  const Real sinh_s = -std::expm1(-2 * m * sigma) / 2, cosh_s = 1 - sinh_s;
  const Real sinh_a = -std::expm1(-2 * m * alpha) / 2, cosh_a = 1 - sinh_a;
  const Real near = decay * m * std::sinh(beta);
  return {.p = sinh_s * sinh_x * std::sinh(alpha) - near * std::sinh(sigma) * sinh_a,
          .q = (sinh_x * (sinh_s * std::cosh(alpha) + m * cosh_s * std::sinh(alpha)) -
                near * (m * std::sinh(sigma) * cosh_a + std::cosh(sigma) * sinh_a)) /
               m2};
}

/// A term of the sum for the drag factor, without the factor sinh(alpha)/3.
Real term(Real n, Real alpha, const Surface& surface) {
  const Real m = n + Real(0.5), m2 = m * m - 1;
  const Real beta = std::abs(surface.xi), sigma = alpha - surface.xi;
  const BisphericalBasis at(m, sigma);
  const auto drag = [&](Real exponent, const Solution& x) {
    const Real a = std::sinh(alpha), b = m * a + std::cosh(alpha);
    return n * (n + 1) * std::exp(-exponent) * (a * x.p + b * x.q);
  };

  if (surface.condition == Condition::kShearFree) {  // G = w_n = 1/m2, G'' = w_n'' = -1 at xi2 = 0
    return drag(m * (alpha + sigma), {.p = at.k + at.h, .q = at.l / m2 + at.s}) / at.shear_free;
  }
  // The sphere alone moves, at 1 - velocity: G = w_n.
  const Real sinh_b = std::sinh(beta);
  const Real w = (m * sinh_b + std::cosh(beta)) / m2, dw = surface.xi < 0 ? sinh_b : -sinh_b;
  const Real alone = drag(m * (alpha + beta + sigma), solve(at, m2, w, dw)) / at.no_slip;
  // Both move, at velocity. The fluid in a cavity moves along, without drag.
  const Real together =
      surface.xi < 0 ? 2 * drag(2 * m * alpha, solve_together(at, m, alpha, beta)) / at.no_slip : 0;
  return (1 - surface.velocity) * alone + together;
}

double drag_factor(Real alpha, const Surface& surface) {
  Real sum = 0, size = 0;
  for (Real n = 1;; ++n) {
    const Real t = term(n, alpha, surface);
    sum += t;
    size += std::abs(t);
    // From (2n+1) alpha = 16 on the terms fall by exp(-alpha) at least each time, so that the rest
    // is below 1/alpha times the last.
    const bool falling = (2 * n + 1) * alpha > 16;
    if (falling && std::abs(t) < Real(1e-18) * std::min(alpha, Real(1)) * size) break;
  }
  return static_cast<double>(std::sinh(alpha) / 3 * sum);
}

/// xi >= 0 with cosh(xi) - 1 = excess, which keeps all digits of a small gap.
Real xi_from_excess(Real excess) { return 2 * std::asinh(std::sqrt(excess / 2)); }

}  // namespace

double bispherical_plane_factor(double epsilon) {
  return drag_factor(xi_from_excess(epsilon), {.xi = 0});
}

double free_surface_drag_factor(double epsilon) {
  return drag_factor(xi_from_excess(epsilon), {.xi = 0, .condition = Condition::kShearFree});
}

double two_sphere_drag_factor(double epsilon, double radius_ratio, double velocity_ratio) {
  // cosh(alpha) = (d^2 + 1 - k^2)/(2d), cosh(beta) = (d^2 + k^2 - 1)/(2dk), d the distance of the
  // centres over r.
  const Real e = epsilon, k = radius_ratio, d = 1 + k + e;
  const Real alpha = xi_from_excess(e * (2 * k + e) / (2 * d));
  const Real beta = xi_from_excess(e * (2 + e) / (2 * d * k));
  return drag_factor(alpha, {.xi = -beta, .velocity = velocity_ratio});
}

double cavity_drag_factor(double epsilon, double cavity_radius_ratio) {
  // The formulas of two_sphere_drag_factor() with -k for k, and d < 0.
  const Real e = epsilon, k = cavity_radius_ratio, d = k - 1 - e;
  if (d <= 0) return concentric_cavity_drag_factor(cavity_radius_ratio);  // alpha is infinite
  const Real alpha = xi_from_excess(e * (2 * k - e) / (2 * d));
  const Real beta = xi_from_excess(e * (2 + e) / (2 * d * k));
  return drag_factor(alpha, {.xi = beta});
}

double concentric_cavity_drag_factor(double cavity_radius_ratio) {
  // (1 - x^5)/(1 - (9/4) x + (5/2) x^3 - (9/4) x^5 + x^6), x = r/R: with 1 - x taken out above, and
  // (1 - x)^4 below.
  const double x = 1 / cavity_radius_ratio, width = (cavity_radius_ratio - 1) / cavity_radius_ratio;
  return (1 + x * (1 + x * (1 + x * (1 + x)))) / (width * width * width * (1 + x * (1.75 + x)));
}

}  // namespace viscontact
