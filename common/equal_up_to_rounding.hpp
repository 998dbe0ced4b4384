// Comparison of quantities that two files give, such as the radius or viscosity of a case and of
// its fit. Pipeline, sweeps, rolling and fits refuse files that differ; a smaller tolerance would
// refuse files that have only been rounded.
#pragma once

#include <algorithm>
#include <cmath>

namespace viscontact {

/// True if two numbers differ by a relative 1e-12 at most. Conversions of units leave rounding
/// errors of some 1e-16, and files that are written with 12 digits or more differ by no more; no
/// result depends on such a difference. Numbers of either sign may be given. False if one is NaN.
inline bool equal_up_to_rounding(double first, double second) {
  constexpr double kRelative = 1e-12;
  return std::abs(first - second) <= kRelative * std::max(std::abs(first), std::abs(second));
}

}  // namespace viscontact
