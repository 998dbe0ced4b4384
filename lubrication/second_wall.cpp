#include "viscontact/lubrication/second_wall.hpp"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "viscontact/common/text/number.hpp"

namespace viscontact::lubrication {
namespace {

/// The first word, without a comma.
std::string first_word(const std::string& words) {
  std::istringstream in(words);
  std::string word;
  in >> word;
  if (word.ends_with(',')) word.pop_back();
  return word;
}

/// The number > 0 after the word `name` in `words`; nothing if there is none.
std::optional<double> length_after(const std::string& words, std::string_view name) {
  std::istringstream in(words);
  std::string before;
  for (std::string word; in >> word; before = word) {
    if (before != name) continue;
    if (word.ends_with(',')) word.pop_back();
    const auto number = parse_number(word);
    return number && *number > 0 ? number : std::nullopt;
  }
  return {};
}

}  // namespace

std::optional<SecondWall> second_wall(const std::string& geometry, const std::string& container,
                                      double radius) {
  const auto kind = first_word(geometry);
  const auto wall = [](double largest_gap, double factor) -> std::optional<SecondWall> {
    if (!(largest_gap > 0)) return {};
    return SecondWall{largest_gap, factor};
  };
  const auto neighbour = length_after(geometry, "radius");
  if (kind == "cavity") {
    if (!neighbour || !(*neighbour > radius)) return {};
    const double share = *neighbour / (*neighbour - radius);
    return wall(2 * (*neighbour - radius), share * share);
  }
  const auto height = length_after(container, "height");
  if (!container.starts_with("closed cylinder") || !height) return {};
  if (kind == "plane" || kind == "free_surface" || kind == "rough_plane")
    return wall(*height - 2 * radius, 1);
  // Both spheres move away from the middle by half of the change of the gap.
  if (kind == "sphere" && neighbour)
    return wall(*height - 4 * std::max(radius, *neighbour), radius < *neighbour ? 0 : 2);
  return {};
}

}  // namespace viscontact::lubrication
