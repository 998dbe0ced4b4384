// The colours of curves, and colour scales. A scale is given by nodes and is linear between them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>

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

struct ColourNode {
  double place;               ///< position on the scale, in any unit
  std::array<double, 3> rgb;  ///< red, green, blue from 0 to 255
};

/// The colour "#rrggbb" at a place of the scale. Red, green and blue are interpolated linearly
/// between the two nodes around the place. A place before the first node has the colour of the
/// first node, and a place after the last node that of the last. There must be at least two nodes,
/// with increasing places.
std::string colour_between(std::span<const ColourNode> nodes, double place);

}  // namespace viscontact::report
