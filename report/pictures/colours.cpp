// Interpolates red, green and blue linearly between the nodes of a colour scale (colours.hpp).
#include "viscontact/report/pictures/colours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace viscontact::report {

std::string colour_between(std::span<const ColourNode> nodes, double place) {
  std::size_t i = 1;
  while (i + 1 < nodes.size() && nodes[i].place < place) ++i;
  const auto &a = nodes[i - 1], &b = nodes[i];
  const double share = std::clamp((place - a.place) / (b.place - a.place), 0.0, 1.0);
  std::array<long, 3> rgb{};
  for (std::size_t c = 0; c < rgb.size(); ++c)
    rgb[c] = std::lround(std::lerp(a.rgb[c], b.rgb[c], share));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

}  // namespace viscontact::report
