// Words of units, such as "kg m/s".
#include "viscontact/common/text/units.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <utility>

namespace viscontact {

std::string Units::words() const {
  return are_said() ? "length " + length + ", time " + time + ", mass " + mass : "";
}

Units Units::of_words(const std::string& text) {
  Units units;
  const auto between = [&](std::string_view before, std::string_view after) {
    const auto from = text.find(before);
    if (from == std::string::npos) return std::string();
    const auto start = from + before.size();
    return text.substr(start, after.empty() ? after.size() - 1 : text.find(after, start) - start);
  };
  units.length = between("length ", ", time ");
  units.time = between(", time ", ", mass ");
  units.mass = between(", mass ", "");
  return units;
}

namespace {

/// The product of the words with these powers, and with `times` between two factors. The symbol "/"
/// stands before the words with negative powers.
std::string quantity(const Units& words, std::string_view times, int mass_power, int length_power,
                     int time_power) {
  constexpr std::array<std::string_view, 10> kPowers = {"",  "",  "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string above, below;
  int factors_below = 0;
  const std::array<std::pair<const std::string*, int>, 3> factors = {
      {{&words.mass, mass_power}, {&words.length, length_power}, {&words.time, time_power}}};
  for (const auto& [word, power] : factors) {
    if (power == 0) continue;
    auto& side = power > 0 ? above : below;
    if (power < 0) ++factors_below;
    if (!side.empty()) side += times;
    side += *word;
    side += kPowers.at(static_cast<std::size_t>(std::abs(power)));
  }
  if (below.empty()) return above;
  return (above.empty() ? "1" : above) + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

struct NamedUnit {
  std::array<int, 3> powers;  ///< of kg, m and s
  std::string_view name;
  std::string_view dimension;  ///< as texts write it, without signs of powers
};

constexpr std::array<NamedUnit, 4> kNamedUnits = {{{{1, 1, -2}, "N", "M L/T2"},
                                                   {{1, 2, -2}, "N m", "M L2/T2"},
                                                   {{1, -1, -2}, "Pa", "M/(L T2)"},
                                                   {{1, -1, -1}, "Pa s", "M/(L T)"}}};

bool are_si(const Units& units) {
  return units.mass == "kg" && units.length == "m" && units.time == "s";
}

/// The named unit of a dimension, which may have superscripts of HTML; empty if there is none.
std::string_view named_unit_of(std::string_view dimension) {
  std::string plain(dimension);
  for (const std::string_view mark : {"<sup>", "</sup>"})
    for (auto at = plain.find(mark); at != std::string::npos; at = plain.find(mark))
      plain.erase(at, mark.size());
  const auto named = std::ranges::find(kNamedUnits, plain, &NamedUnit::dimension);
  return named == kNamedUnits.end() ? std::string_view() : named->name;
}

}  // namespace

std::string Units::unit_of(int mass_power, int length_power, int time_power) const {
  if (are_si(*this))
    for (const auto& named : kNamedUnits)
      if (named.powers == std::array{mass_power, length_power, time_power})
        return std::string(named.name);
  return are_said() ? quantity(*this, " ", mass_power, length_power, time_power) : "";
}

std::string Units::in_brackets(int mass_power, int length_power, int time_power) const {
  return are_said() ? " [" + unit_of(mass_power, length_power, time_power) + "]" : "";
}

std::string Units::unit_or_dimension(int mass_power, int length_power, int time_power) const {
  return are_said()
             ? unit_of(mass_power, length_power, time_power)
             : quantity({"length", "time", "mass"}, " × ", mass_power, length_power, time_power);
}

std::string Units::in_brackets_of(std::string text) const {
  if (!are_said()) return text;
  std::string result;
  for (std::size_t from = 0; from < text.size();) {
    const auto open = text.find('[', from), close = text.find(']', open);
    if (close == std::string::npos) return result + text.substr(from);
    const std::string_view inside = std::string_view(text).substr(open + 1, close - open - 1);
    const bool is_dimension =
        inside.find_first_of("MLT") != std::string_view::npos &&
        inside.find_first_not_of("MLT1234567890/() <>sup-") == std::string_view::npos;
    result += text.substr(from, open + 1 - from);
    from = close;
    if (const auto named = are_si(*this) ? named_unit_of(inside) : ""; !named.empty()) {
      result += named;
      continue;
    }
    for (const char c : inside) {
      if (!is_dimension)
        result += c;
      else
        result += c == 'M' ? mass : c == 'L' ? length : c == 'T' ? time : std::string(1, c);
    }
  }
  return result;
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

}  // namespace viscontact
