// The colours of curves, and scales of colours for gamma, speeds and pressures. gamma is minus the
// impulse that a film has absorbed [M L/T], of discs in a fluid per length [M/T]. All reports use
// it. A change must keep colours that colour-blind readers can tell apart. Nothing is thrown.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace viscontact::report {

/// Colours that colour-blind readers can tell apart (Okabe & Ito 2008).
inline constexpr const char* kBlack = "#000000";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kSkyBlue = "#56B4E9";
inline constexpr const char* kBluishGreen = "#009E73";
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermilion = "#D55E00";
inline constexpr const char* kReddishPurple = "#CC79A7";

/// The colours of curves in the order in which a page uses them. A page gives each of its curves a
/// place here, and draws it in this colour in all its pictures, so that readers find it again.
/// Colour-blind readers can tell the first seven apart. The first two can be seen on the colour
/// scale of maps, too.
inline constexpr auto kCurveColours = std::to_array<const char*>(
    {kSkyBlue,  kVermilion, kBluishGreen, kReddishPurple, kBlue,     kOrange,   kBlack,
     "#7F7F7F", "#8C564B",  "#17BECF",    "#6A3D9A",      "#B5BD00", "#E31A1C", "#1F3B73",
     "#33A02C", "#F781BF",  "#A65628",    "#00A08A",      "#FDBF6F", "#5B5EA6", "#C0C0C0"});

/// The colour of the curve with this place. After the last colour the first one follows again.
constexpr const char* curve_colour(std::size_t place) {
  return kCurveColours[place % kCurveColours.size()];
}

/// A scale of colours with the numbers beside it, for a still picture or a page.
struct ColourScale {
  std::string words;                                  ///< what is shown, with its dimension
  std::vector<std::string> colours;                   ///< "#rrggbb", from left to right
  std::vector<std::pair<double, std::string>> ticks;  ///< shares of the width, and their texts
};

/// The colour "#rrggbb" for share = gamma/lowest from 0 (light) to 1 (dark).
std::string film_colour(double share);

/// The scale of gamma from `lowest` < 0 to 0 with `colours` colours and these words.
ColourScale film_scale(double lowest, int colours, const std::string& words);

inline constexpr const char* kTouchingColour = "#5a5a5a";  ///< for contacts with gamma = 0
inline constexpr const char* kSlidingColour = "#d55e00";   ///< for contacts that slide

/// The colour "#rrggbb" of a contact without a film for the share of Coulomb's bound that its
/// friction has reached, from 0 (kTouchingColour) to 1 (kSlidingColour).
std::string friction_colour(double share);

/// The scale of that share from 0 to 1 with `colours` colours and these words.
ColourScale friction_scale(int colours, const std::string& words);

/// The colour "#rrggbb" for share = speed / top speed from 0 (nearly white) to 1 (blue). The
/// colours are evenly spaced in lightness, and dark lines can be seen on all of them.
std::string speed_colour(double share);

/// The scale of the speed of a fluid from 0 to `top` >= 0 [L/T] with `colours` colours; its words
/// have `unit` in brackets.
ColourScale speed_scale(double top, int colours, const std::string& unit = "length/time");

inline constexpr const char* kStreamLineColour = "#12233f";

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

  /// The scale from `low` to `high` with `colours` colours, without numbers that would touch
  /// another one, for a pressure minus its mean; its words have `unit` in brackets.
  ColourScale scale(int colours, const std::string& unit = "viscosity/time") const;

  /// The place of a pressure on that scale, from 0 to 1.
  double share_of(double pressure) const;

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
