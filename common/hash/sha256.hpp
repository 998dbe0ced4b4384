// SHA-256 (FIPS 180-4), with which files of Viscontact identify the content of other files. All
// parts that write results use it. A change must keep the hashes, because published files contain
// them and commands compare them to see what is up to date. Nothing is thrown; a failure of OpenSSL
// is asserted, and a build without assertions then returns a wrong text.
#pragma once

#include <string>
#include <string_view>

namespace viscontact {

/// The SHA-256 of the bytes as 64 lower-case hexadecimal digits. There may be no bytes.
std::string sha256(std::string_view bytes);

}  // namespace viscontact
