// Ranges of a sweep, grids and random points.
#include "viscontact/sweep/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/splitmix.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::sweep {
namespace {

// More rows take too long: 1e12 rows at a microsecond each take 12 days. The product of the numbers
// of values is a double, which is exact up to 2^53 = 9e15, so that it can be compared with
// kMostPoints.
constexpr double kMostValues = 1e9;
constexpr double kMostPoints = 1e12;

/// Throws Error(kBadInput) with the text of the range, the fault `what` and the allowed forms.
[[noreturn]] void refuse(std::string_view text, const std::string& what) {
  throw Error(ErrorKind::kBadInput,
              "{}: {}; it must be KEY=FROM:TO:log:COUNT, KEY=FROM:TO:COUNT or KEY=VALUE,VALUE,...",
              text, what);
}

/// There is at least one part; parts may be empty.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

}  // namespace

double Variation::value(std::uint64_t i) const {
  assert(i < count);
  if (!values.empty()) return values[i];
  if (i == 0) return first;
  if (i + 1 == count) return last;
  // With this formula the middle of a range that is symmetric about 0 is exactly 0.
  if (!logarithmic)
    return (first * static_cast<double>(count - 1 - i) + last * static_cast<double>(i)) /
           static_cast<double>(count - 1);
  return at(static_cast<double>(i) / static_cast<double>(count - 1));
}

double Variation::at(double share) const {
  assert(share >= 0 && share < 1);
  if (!values.empty())
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size()))];
  if (!logarithmic) return std::lerp(first, last, share);
  // The logarithms are interpolated, because the ratio of the ends may overflow. The result is
  // clamped, because a rounding error must not lead outside the range.
  const double size =
      std::exp(std::lerp(std::log(std::abs(first)), std::log(std::abs(last)), share));
  const double a = std::abs(first), b = std::abs(last);
  return std::copysign(std::clamp(size, std::min(a, b), std::max(a, b)), first);
}

Variation parse_variation(std::string_view text) {
  Variation variation;
  const auto equals = text.find('=');
  if (equals == std::string_view::npos || equals == 0) refuse(text, "KEY= is missing");
  variation.key = text.substr(0, equals);
  const auto number = [&](std::string_view part) {
    const auto value = parse_number(part);
    if (!value) refuse(text, fmt::format("'{}' is not a finite number", part));
    return *value;
  };
  const auto range = split(text.substr(equals + 1), ':');
  if (range.size() == 1) {
    for (const auto part : split(range[0], ',')) variation.values.push_back(number(part));
    variation.count = variation.values.size();
    return variation;
  }
  variation.logarithmic = range.size() == 4;
  if (range.size() != 3 && !(range.size() == 4 && range[2] == "log"))
    refuse(text, "this is not a range");
  variation.first = number(range[0]);
  variation.last = number(range[1]);
  const double count = number(range.back());
  if (!(count >= 1 && count <= kMostValues && count == std::floor(count)))
    refuse(text, fmt::format("COUNT is {} and not a whole number from 1 to 1e9", range.back()));
  variation.count = static_cast<std::uint64_t>(count);
  if (variation.logarithmic && (variation.first == 0 || variation.last == 0 ||
                                std::signbit(variation.first) != std::signbit(variation.last)))
    refuse(text, "a logarithmic range must not contain 0 or change sign");
  return variation;
}

std::vector<std::pair<std::string, double>> grid_point(const std::vector<Variation>& variations,
                                                       std::uint64_t index) {
  assert(index < grid_size(variations));
  std::vector<std::pair<std::string, double>> point(variations.size());
  for (std::size_t i = variations.size(); i-- > 0;) {
    point[i] = {variations[i].key, variations[i].value(index % variations[i].count)};
    index /= variations[i].count;
  }
  return point;
}

std::vector<std::pair<std::string, double>> random_point(const std::vector<Variation>& variations,
                                                         std::uint64_t index, std::uint64_t seed) {
  std::vector<std::pair<std::string, double>> point;
  for (std::size_t i = 0; i < variations.size(); ++i) {
    const std::uint64_t bits = splitmix_hash(splitmix_hash(splitmix_hash(seed) + index) + i);
    point.emplace_back(variations[i].key, variations[i].at(unit_interval_of(bits)));
  }
  return point;
}

std::uint64_t grid_size(const std::vector<Variation>& variations) {
  double size = 1;
  for (const auto& variation : variations) size *= static_cast<double>(variation.count);
  if (size > kMostPoints)
    throw Error(ErrorKind::kWrongUsage, "the grid has {:.3g} points; at most {:.0e} are allowed",
                size, kMostPoints);
  std::uint64_t points = 1;
  for (const auto& variation : variations) points *= variation.count;
  return points;
}

std::uint64_t Points::count() const { return samples > 0 ? samples : grid_size(variations); }

std::uint64_t Points::rows() const { return count() * std::max<std::uint64_t>(draws, 1); }

std::vector<std::string> Points::keys() const {
  std::vector<std::string> keys;
  for (const auto& variation : variations) keys.push_back(variation.key);
  if (draws > 0) keys.emplace_back(kDrawKey);
  return keys;
}

std::vector<std::pair<std::string, double>> Points::numbers(std::uint64_t index) const {
  assert(index < rows());
  const std::uint64_t draws_here = std::max<std::uint64_t>(draws, 1);
  auto numbers = samples > 0 ? random_point(variations, index / draws_here, seed)
                             : grid_point(variations, index / draws_here);
  if (draws > 0)
    numbers.emplace_back(kDrawKey,
                         static_cast<double>(first_draw) + static_cast<double>(index % draws));
  return numbers;
}

std::string Points::key_fields(std::uint64_t index) const {
  std::string text;
  for (const auto& [key, value] : numbers(index))
    text += (text.empty() ? "" : ",") + format_number(value);
  return text;
}

bool Points::is_varied(const std::string& key) const {
  return std::ranges::find(variations, key, &Variation::key) != variations.end();
}

std::string text_of(const Points& points) {
  std::string text = fmt::format("{} {}", points.samples, points.seed);
  for (const auto& v : points.variations) {
    text += fmt::format(" {} {} {} {} {}", v.key, v.first, v.last, v.logarithmic, v.count);
    for (const double value : v.values) text += " " + format_number(value);
  }
  return text;
}

std::string in_words(const std::vector<std::pair<std::string, double>>& numbers) {
  std::string text;
  for (const auto& [key, value] : numbers) text += fmt::format(" {} = {}", key, value);
  return text;
}

}  // namespace viscontact::sweep
