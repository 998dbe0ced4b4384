#include "viscontact/common/text/base64.hpp"

#include <array>
#include <cstdint>

namespace viscontact {
namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::uint8_t kNoDigit = 64;

constexpr auto kValues = [] {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (std::size_t k = 0; k < kDigits.size(); ++k)
    values[static_cast<unsigned char>(kDigits[k])] = static_cast<std::uint8_t>(k);
  return values;
}();

}  // namespace

std::string to_base64(std::span<const std::byte> bytes) {
  std::string text(base64_size(bytes.size()), '=');
  const auto byte = [&](std::size_t k) { return std::to_integer<std::uint32_t>(bytes[k]); };
  std::size_t from = 0, to = 0;
  const auto put = [&](std::uint32_t group, int digits) {
    for (int d = 0; d < digits; ++d) text[to++] = kDigits[group >> (18 - 6 * d) & 63];
  };
  for (; from + 3 <= bytes.size(); from += 3)
    put(byte(from) << 16 | byte(from + 1) << 8 | byte(from + 2), 4);
  if (bytes.size() - from == 1) put(byte(from) << 16, 2);
  if (bytes.size() - from == 2) put(byte(from) << 16 | byte(from + 1) << 8, 3);
  return text;
}

std::optional<std::string> from_base64(std::string_view text) {
  if (text.size() % 4 != 0) return {};
  const std::size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
  text.remove_suffix(padding);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t group = 0;
  int bits = 0;  // that `group` has and `bytes` has not
  for (const char digit : text) {
    const auto value = kValues[static_cast<unsigned char>(digit)];
    if (value == kNoDigit) return {};
    group = group << 6 | value;
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<char>(group >> bits & 255));
    }
  }
  return bytes;
}

}  // namespace viscontact
