// SHA-256 (FIPS 180-4), by which files of Viscontact refer to the content of other files.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace viscontact
