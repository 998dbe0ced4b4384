// The colours of curves, and scales of colours for gamma, friction, speeds and pressures. A share
// is a place on a scale [1]; below 0 or above 1 it gets the colour of the nearer end.
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

/// The colours of curves. A page draws each of its curves in the same colour in all its pictures.
/// Colour-blind readers can tell the first seven apart. The first two can also be seen on a map,
/// which is a picture that shows values as colours.
inline constexpr auto kCurveColours = std::to_array<const char*>(
    {kSkyBlue,  kVermilion, kBluishGreen, kReddishPurple, kBlue,     kOrange,   kBlack,
     "#7F7F7F", "#8C564B",  "#17BECF",    "#6A3D9A",      "#B5BD00", "#E31A1C", "#1F3B73",
     "#33A02C", "#F781BF",  "#A65628",    "#00A08A",      "#FDBF6F", "#5B5EA6", "#C0C0C0"});

/// The colour at a place in kCurveColours, which begins again after its end.
constexpr const char* curve_colour(std::size_t place) {
  return kCurveColours[place % kCurveColours.size()];
}

/// A scale of colours with its numbers, for a still picture or a page.
struct ColourScale {
  std::string words;                                  ///< what it shows, with the unit or dimension
  std::vector<std::string> colours;                   ///< "#rrggbb", from the left, evenly spaced
  std::vector<std::pair<double, std::string>> ticks;  ///< shares of the width, 0 to 1, with texts
};

/// The colour "#rrggbb" for share = gamma/(lowest gamma), from 0 (light yellow) to 1 (dark violet).
/// gamma is minus the impulse that the film of a contact has absorbed.
std::string film_colour(double share);

/// The scale of gamma from `lowest` < 0 (left) to 0, with `colours` >= 2 colours and with `words`
/// as ColourScale::words.
ColourScale film_scale(double lowest, int colours, const std::string& words);

inline constexpr const char* kTouchingColour = "#5a5a5a";  ///< for contacts with gamma = 0
inline constexpr const char* kSlidingColour = "#d55e00";   ///< for contacts that slide

/// The colour "#rrggbb" of a contact without a film, by its friction over Coulomb's bound: from 0
/// (kTouchingColour) to 1 (kSlidingColour).
std::string friction_colour(double share);

/// The scale of friction_colour() from 0 to 1, with `colours` >= 2 colours.
ColourScale friction_scale(int colours, const std::string& words);

/// The colour "#rrggbb" for share = speed/(speed at the end of the scale), from 0 (nearly white) to
/// 1 (blue). The lightness falls in even steps, and dark lines can be seen on all of these colours.
std::string speed_colour(double share);

/// The scale of the speed of a fluid from 0 to `top` >= 0 [L/T], with `colours` >= 2 colours.
/// `unit` is that of `top` in words.
ColourScale speed_scale(double top, int colours, const std::string& unit = "length/time");

inline constexpr const char* kStreamLineColour = "#12233f";

/// A scale of colours for pressures: blue below 0, white at 0 and red above 0. The position of a
/// pressure on the scale is the pressure itself or, if linear_below > 0, asinh(pressure /
/// linear_below) / ln 10, which is linear for small and logarithmic for large pressures. Pressures
/// beyond an end of the scale have the colour of that end.
struct PressureColours {
  double low = 0, high = 0;          ///< the ends of the scale [M/(L T^2)], low < high
  double smallest = 0, largest = 0;  ///< of all pressures [M/(L T^2)]
  /// The pressure up to which the scale is linear [M/(L T^2)], >= 0; 0: it is linear everywhere.
  double linear_below = 0;

  /// The position of a pressure [M/(L T^2)] on the scale: that pressure, or with linear_below > 0 a
  /// number [1]. gnuplot gets positions as the values of a field, which settings() must fit.
  double at(double pressure) const;

  /// The colour "#rrggbb" at a position `place`, a result of at().
  std::string colour_at(double place) const;

  /// Round pressures [M/(L T^2)] with their texts, for the numbers beside the scale. The pressures
  /// of a logarithmic scale may lie outside its ends.
  std::vector<std::pair<double, std::string>> ticks() const;

  /// The scale from `low` to `high`, with `colours` >= 2 colours, for a pressure minus its mean;
  /// `unit` is that of the pressure in words. A number that would touch another is left out.
  ColourScale scale(int colours, const std::string& unit = "viscosity/time") const;

  /// 0 at `low`, 1 at `high`, and below 0 or above 1 for a pressure outside these ends.
  double share_of(double pressure) const;

  /// Commands of gnuplot for the palette, range, numbers and words of the scale. Its words give the
  /// pressure in units of viscosity times velocity over length.
  std::vector<std::string> settings() const;
};

/// A linear scale from the smallest to the largest of the pressures [M/(L T^2)] that are finite. If
/// the relative difference of the two is at most 1e-9, the scale reaches from p - |p| to p + |p|,
/// where p is the pressure; it reaches from -1 to 1 if p = 0 or no pressure is finite.
PressureColours proportional_colours(const std::vector<double>& pressures);

/// A scale for the pressures of pixels [M/(L T^2)], of which a few may be much larger than all
/// others. Pressures that are not finite do not count. The highest 0.5 % are cut off if the largest
/// of the others is > 0 and less than a third of the largest pressure: the scale then ends at the
/// largest of the others, rounded up; likewise the lowest 0.5 % below 0. If an end is cut, or is
/// more than ten times the pressure `usual` >= 0, the scale is linear below the power of ten
/// nearest to `usual` and logarithmic beyond it; if `usual` is 0, the scale stays linear. If no
/// pressure is finite, the scale reaches from -1 to 1.
PressureColours robust_colours(const std::vector<double>& pixels, double usual);

}  // namespace viscontact::report
