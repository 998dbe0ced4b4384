// Colours for pressures [M/(L T^2)]. In a thin film, a few pressures are a million times larger
// than all others, so the scale may be logarithmic.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace viscontact::report {

/// A scale that is blue below 0, white at 0 and red above 0. It is proportional to the pressure, or
/// to asinh(pressure / linear_below), which is linear for small and logarithmic for large
/// pressures. Pressures beyond an end of the bar have the colour of that end.
struct PressureColours {
  double low = 0, high = 0;          ///< the ends of the bar [M/(L T^2)], low < high
  double smallest = 0, largest = 0;  ///< extremes of the pressures [M/(L T^2)]
  double linear_below = 0;           ///< [M/(L T^2)]; 0: proportional to the pressure

  /// The position of a pressure on the scale, which gnuplot gets as the value.
  double at(double pressure) const;

  /// The colour "#rrggbb" at a position on the scale.
  std::string colour_at(double place) const;

  /// Round pressures in the bar with their texts, which should stand beside it.
  std::vector<std::pair<double, std::string>> ticks() const;

  /// Commands of gnuplot for palette, range, numbers and words of the bar.
  std::vector<std::string> settings() const;
};

/// A proportional scale from the smallest to the largest of the pressures.
PressureColours proportional_colours(const std::vector<double>& pressures);

/// A scale for pixels of which a few may have a much larger pressure than all others. If the
/// largest of all is more than three times the largest that remains without the highest 0.5 %, the
/// bar ends at the latter, rounded up; and likewise for the lowest. In this case, and also if an
/// end of the bar is more than ten times the pressure `usual` (> 0), the scale is logarithmic above
/// about `usual`.
PressureColours robust_colours(const std::vector<double>& pixels, double usual);

}  // namespace viscontact::report
