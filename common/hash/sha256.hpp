// The hash by which files name each other.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// Lower-case hexadecimal SHA-256 of the bytes (64 characters).
std::string sha256(std::string_view bytes);

}  // namespace viscontact
