// SHA-256 (FIPS 180-4), with which files identify the content of other files.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// The hash as 64 lower-case hexadecimal digits. A failure of OpenSSL is asserted.
std::string sha256(std::string_view bytes);

}  // namespace viscontact
