// The difference sinh(x) - x without loss of digits, which series for small gaps contain.
#pragma once

#include <cmath>

namespace viscontact {

/// sinh(x) - x without cancellation, x >= 0.
inline long double sinh_minus_argument(long double x) {
  if (x > 1) return std::sinh(x) - x;
  long double term = x, sum = 0;
  for (int k = 1; k < 15; ++k) {  // x^29/29! < 1e-30, below the rounding errors of a long double
    term *= x * x / static_cast<long double>((2 * k) * (2 * k + 1));
    sum += term;
  }
  return sum;
}

}  // namespace viscontact
