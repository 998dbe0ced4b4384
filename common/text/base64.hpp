// Bytes as text in base64 (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace viscontact {

/// Characters that `bytes` bytes have in base64, with padding.
constexpr std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// The bytes in base64 with padding.
std::string to_base64(std::span<const std::byte> bytes);

/// Nothing if the text is not base64 with padding.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace viscontact
