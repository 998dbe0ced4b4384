// Numbers by std::to_chars and std::from_chars.
#include "viscontact/common/text/number.hpp"

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace viscontact {

void append_number(std::string& text, double value) {
  assert(std::isfinite(value));
  std::array<char, 32> buffer;  // the longest text is -2.2250738585072014e-308
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  text.append(buffer.data(), end);
}

std::string format_number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::optional<double> parse_number(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  // std::from_chars accepts a minus but no plus.
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace viscontact
