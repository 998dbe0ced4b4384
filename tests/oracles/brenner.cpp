#include "tests/oracles/brenner.hpp"

#include <cmath>

#include "tests/oracles/sinh_minus_argument.hpp"

namespace viscontact {
double brenner_drag_factor(double epsilon) {
  // cosh(alpha) - 1 = epsilon = 2 sinh^2(alpha/2): no digit is lost for small gaps.
  const long double alpha = 2 * std::asinh(std::sqrt(static_cast<long double>(epsilon) / 2));
  const long double sinh_alpha = std::sinh(alpha);
  long double sum = 0;
  for (long double n = 1;; ++n) {
    const long double k = 2 * n + 1;
    const long double x = k * alpha;
    // The bracket is (N - D)/D. With 4 sinh^2(x/2) = 2 cosh(x) - 2,
    //   D = (2 sinh(x/2) - k sinh(alpha)) (2 sinh(x/2) + k sinh(alpha)),
    // whose first factor cancels near contact: 2 sinh(x/2) - k sinh(alpha) = 2 (sinh(x/2) - x/2) -
    // k (sinh(alpha) - alpha).
    const long double first = 2 * sinh_minus_argument(x / 2) - k * sinh_minus_argument(alpha);
    const long double denominator = first * (2 * std::sinh(x / 2) + k * sinh_alpha);
    // N - D = 2 (sinh x - cosh x) + 2 + k sinh(2 alpha) + k^2 sinh^2(alpha), sinh x - cosh x =
    // -exp(-x).
    const long double numerator =
        -2 * std::expm1(-x) + k * std::sinh(2 * alpha) + k * k * sinh_alpha * sinh_alpha;
    const long double term = n * (n + 1) / ((2 * n - 1) * (2 * n + 3)) * numerator / denominator;
    sum += term;
    // From x = 4 on the terms fall by exp(-2 alpha) each; what is left is a 1/(2 alpha)-fold of the
    // last: 1e-17 at most.
    if (x > 4 && term < 1e-20L * sum) break;
  }
  return static_cast<double>(4.0L / 3 * sinh_alpha * sum);
}

}  // namespace viscontact
