// Composes the words of units (units.hpp). Nothing is thrown.
#include "viscontact/case_file/units.hpp"

#include <array>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

namespace viscontact::case_file {

std::string Units::words() const {
  return are_said() ? "length " + length + ", time " + time + ", mass " + mass : "";
}

std::string Units::unit_of(int mass_power, int length_power, int time_power) const {
  if (!are_said()) return "";
  constexpr std::array<std::string_view, 10> kPowers = {"",  "",  "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string above, below;
  int factors_below = 0;
  const std::array<std::pair<const std::string*, int>, 3> factors = {
      {{&mass, mass_power}, {&length, length_power}, {&time, time_power}}};
  for (const auto& [word, power] : factors) {
    if (power == 0) continue;
    auto& side = power > 0 ? above : below;
    if (power < 0) ++factors_below;
    if (!side.empty()) side += ' ';
    side += *word;
    side += kPowers.at(static_cast<std::size_t>(std::abs(power)));
  }
  if (below.empty()) return above;
  return (above.empty() ? "1" : above) + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

std::string Units::in_place_of_dimensions(const std::string& html) const {
  if (!are_said()) return html;
  std::istringstream in(html);
  std::string text;
  for (std::string word; in >> word;) {
    const std::string_view rest = std::string_view(word).substr(1);
    const std::string* unit = word[0] == 'M'   ? &mass
                              : word[0] == 'L' ? &length
                              : word[0] == 'T' ? &time
                                               : nullptr;
    if (!text.empty()) text += ' ';
    text += unit != nullptr && (rest.empty() || rest.starts_with("<sup>"))
                ? *unit + std::string(rest)
                : word;
  }
  return text;
}

}  // namespace viscontact::case_file
