// What the fuzz targets share. A target is a program's whole way of dealing with a file of any
// bytes: read it, and if it is let in, use it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "viscontact/common/error.hpp"

/// libFuzzer's interface; one target defines it. Anything thrown is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace viscontact {

/// A file with these bytes, in a folder of this process alone that lies in memory where there is
/// such a place; the next call replaces it. Beside it are the files that shipped cases name.
std::filesystem::path file_of_bytes(const std::uint8_t* data, std::size_t size,
                                    std::string_view name);

/// Throws std::logic_error, a finding.
void require(bool holds, const char* what);

/// Reads a file. False if it was refused as files are; what else it throws is a finding.
template <class Read>
bool is_let_in(const Read& read) {
  try {
    read();
    return true;
  } catch (const Error& error) {
    require(error.kind() == ErrorKind::kBadInput, "a file was refused with another exit code");
    return false;
  }
}

/// Does something with what was let in. False if that could not be done, which must be said as an
/// Error.
template <class Use>
bool can_be(const Use& use) {
  try {
    use();
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace viscontact
