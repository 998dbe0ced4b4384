// Comparison of quantities that two files give, such as the radius of a case and of its fit.
#pragma once

#include <algorithm>
#include <cmath>

namespace viscontact {

/// True if two finite numbers differ by a relative 1e-12 at most. Conversions of units leave
/// relative rounding errors of some 1e-16, and numbers written with 13 digits are rounded by less
/// than 1e-12; no result depends on such a difference. 0 equals only 0, and NaN nothing.
inline bool equal_up_to_rounding(double first, double second) {
  constexpr double kRelative = 1e-12;
  return std::abs(first - second) <= kRelative * std::max(std::abs(first), std::abs(second));
}

}  // namespace viscontact
