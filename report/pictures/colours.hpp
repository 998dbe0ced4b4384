// The colours of curves, and colour scales, which are given by nodes and linear between them.
#pragma once

#include <array>
#include <span>
#include <string>

namespace viscontact::report {

/// Colours that colour-blind readers tell apart (Okabe & Ito 2008).
inline constexpr const char* kBlack = "#000000";
inline constexpr const char* kOrange = "#E69F00";
inline constexpr const char* kSkyBlue = "#56B4E9";
inline constexpr const char* kBluishGreen = "#009E73";
inline constexpr const char* kBlue = "#0072B2";
inline constexpr const char* kVermilion = "#D55E00";
inline constexpr const char* kReddishPurple = "#CC79A7";

struct ColourNode {
  double place;               ///< position on the scale
  std::array<double, 3> rgb;  ///< red, green, blue from 0 to 255
};

/// The colour "#rrggbb" at a place of the scale. It is linear between nodes; before the first and
/// after the last node it is that of the node. There must be at least two nodes, with increasing
/// places.
std::string colour_between(std::span<const ColourNode> nodes, double place);

}  // namespace viscontact::report
