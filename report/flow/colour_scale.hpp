// A scale of colours: nodes, and what is between them.
#pragma once

#include <array>
#include <span>
#include <string>

namespace viscontact {

struct ColourNode {
  double place;
  std::array<double, 3> rgb;  ///< red, green, blue from 0 to 255
};

/// "#rrggbb" at a place of the scale, linear between nodes; beyond the first or last, theirs. At least two nodes, places rising.
std::string colour_between(std::span<const ColourNode> nodes, double place);

}  // namespace viscontact
