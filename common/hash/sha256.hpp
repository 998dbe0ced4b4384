// SHA-256 (FIPS 180-4), with which files of Viscontact identify the content of other files.
// Published files contain these hashes.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// SHA-256 of the bytes, as 64 lower-case hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace viscontact
