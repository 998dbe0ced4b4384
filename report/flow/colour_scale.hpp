// Colour scales that are given by nodes, with linear interpolation between them.
#pragma once

#include <array>
#include <span>
#include <string>

namespace viscontact {

struct ColourNode {
  double place;               ///< position on the scale
  std::array<double, 3> rgb;  ///< red, green, blue from 0 to 255
};

/// The colour "#rrggbb" at a place of the scale. It is linear between nodes; before the first and
/// after the last node it is that of the node. There must be at least two nodes, with increasing
/// places.
std::string colour_between(std::span<const ColourNode> nodes, double place);

}  // namespace viscontact
