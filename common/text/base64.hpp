// Bytes as text in base64 (RFC 4648, section 4).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace viscontact {

/// Number of characters that `bytes` bytes have in base64, with padding.
constexpr std::size_t base64_size(std::size_t bytes) { return (bytes + 2) / 3 * 4; }

/// The bytes in base64 with padding; empty without bytes.
std::string to_base64(std::span<const std::byte> bytes);

/// The bytes that this text encodes; nothing if it is not base64 with padding.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace viscontact
