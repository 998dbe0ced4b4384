// Functions of bispherical coordinates from which a stream function without slip is made
// (bispherical.cpp). All numbers are dimensionless.
#pragma once

#include <cmath>

#include "tests/oracles/sinh_minus_argument.hpp"

namespace viscontact {

/// S, H, K, L at s = sigma, times exp(-m sigma), where
///
///     S = sinh(m s) sinh(s),   H = m cosh(m s) sinh(s) - sinh(m s) cosh(s),   m = n + 1/2,
///     S' = K = m cosh(m s) sinh(s) + sinh(m s) cosh(s),   S'' = L,   H' = (m^2 - 1) S,
///
/// solve the equation of the stream function and have a double zero at s = 0; n >= 1 numbers the
/// terms of the series. Also the determinants of the conditions at sigma (value and first
/// derivative, value and second derivative), times exp(-2 m sigma). With these factors nothing
/// overflows. All numbers have nearly the precision of a long double.
struct BisphericalBasis {
  long double s, h, k, l;
  long double no_slip;     ///< (m^2-1) S^2 - H K = sinh^2(m sigma) - m^2 sinh^2(sigma)
  long double shear_free;  ///< (m^2-1) S K - H L = m (sinh(2 m sigma) - m sinh(2 sigma))

  BisphericalBasis(long double m, long double sigma) {
    const long double x = m * sigma, decay = std::exp(-x);
    const long double sinh_x = -std::expm1(-2 * x) / 2, cosh_x = (1 + decay * decay) / 2;
    const long double sinh_s = std::sinh(sigma), cosh_s = std::cosh(sigma);
    s = sinh_x * sinh_s;
    k = m * cosh_x * sinh_s + sinh_x * cosh_s;
    l = (m * m + 1) * s + 2 * m * cosh_x * cosh_s;
    if (x < 1) {  // the leading terms of both differences are equal and are left out
      const auto f = [](long double y) { return sinh_minus_argument(y); };
      h = decay * ((m - 1) * f((m + 1) * sigma) - (m + 1) * f((m - 1) * sigma)) / 2;
      no_slip = decay * (f(x) - m * f(sigma)) * (sinh_x + decay * m * sinh_s);
      shear_free = decay * decay * m * (f(2 * x) - m * f(2 * sigma));
    } else {
      h = m * cosh_x * sinh_s - sinh_x * cosh_s;
      no_slip = (sinh_x - decay * m * sinh_s) * (sinh_x + decay * m * sinh_s);
      shear_free = m * (2 * sinh_x * cosh_x - decay * decay * 2 * m * sinh_s * cosh_s);
    }
  }
};

}  // namespace viscontact
