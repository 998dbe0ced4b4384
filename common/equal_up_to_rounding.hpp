// Comparison of quantities that two files give, such as the radius or viscosity of a case and of
// its fit. case_file/, fitting/, lubrication/, motions/, pipeline/, results/, rolling/ and swimmer/
// use this comparison, mostly to refuse files that differ. Nothing is thrown. The tolerance is a
// choice: a smaller one would refuse files that have only been rounded, a larger one would accept
// files whose values differ.
#pragma once

#include <algorithm>
#include <cmath>

namespace viscontact {

/// True if two numbers differ by a relative 1e-12 at most. Conversions of units leave relative
/// rounding errors of some 1e-16, and numbers written with 13 digits are rounded by less than
/// 1e-12; no result depends on such a difference. Both numbers have the same unit and any sign, and
/// must be finite (not checked: with one infinite number the result is true, and two equal
/// infinities give false). 0 equals only 0. The result is false if one number is NaN; nothing is
/// thrown.
inline bool equal_up_to_rounding(double first, double second) {
  constexpr double kRelative = 1e-12;
  return std::abs(first - second) <= kRelative * std::max(std::abs(first), std::abs(second));
}

}  // namespace viscontact
