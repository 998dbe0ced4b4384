// The distances of two spheres at which a fit of their resistance (resistance_fit.hpp) needs
// values. The case of a swimmer tabulates these; a change of any bit makes another table and fit.
// Nothing is thrown. Used by case/.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

namespace viscontact::swimmer {

/// `count` >= 2 rising distances of centres from `from` to `to` [L], 0 < from < to: the extrema of
/// a Chebyshev polynomial in 1/distance, at which polynomials in 1/distance interpolate well
/// (ResistanceFit). Both ends are among them.
inline std::vector<double> chebyshev_arms(double from, double to, int count) {
  std::vector<double> arms;
  for (int i = 0; i < count; ++i) {
    const double share = (1 - std::cos(std::numbers::pi * i / (count - 1))) / 2;
    arms.push_back(1 / ((1 - share) / from + share / to));
  }
  arms.front() = from;
  arms.back() = to;
  return arms;
}

}  // namespace viscontact::swimmer
