// The colours of curves, and colour scales. A scale is given by nodes and is linear between them.
#pragma once

#include <array>
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
