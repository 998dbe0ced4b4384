// Colours for pressures, of which the film has a few that are a million times the others.
#pragma once

#include <string>
#include <vector>

namespace viscontact {

/// Blue below 0, white at 0, red above. Proportional to the pressure, or from +-linear_below on to its logarithm (asinh, so without a
/// kink). Pressures beyond an end of the bar have its colour.
struct PressureColours {
  double low = 0, high = 0;          ///< the ends of the bar [M/(L T^2)], low < high
  double smallest = 0, largest = 0;  ///< pressures that there are
  double linear_below = 0;           ///< 0: proportional throughout

  /// What gnuplot is given in a pressure's place.
  double at(double pressure) const;

  /// gnuplot's palette, range, numbers and words for the bar.
  std::vector<std::string> settings() const;
};

/// For pressures that are all worth a colour of their own: proportional.
PressureColours proportional_colours(const std::vector<double>& pressures);

/// For pixels of which few may outshine all others: the bar ends where 0.5 % of them are beyond, if those reach much farther; then, or where
/// it still spans more than `usual` (> 0) by far, it is logarithmic beyond about that.
PressureColours robust_colours(const std::vector<double>& pixels, double usual);

}  // namespace viscontact
