// What the fuzz targets share. A target gives arbitrary bytes to a reader of files and, if the
// reader accepts them, uses the result as the program would.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "viscontact/common/error.hpp"

/// The interface of libFuzzer, which each target defines. An exception that leaves it is a finding.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace viscontact {

/// Writes a file with these bytes and returns its path. The folder belongs to this process alone
/// and is in memory if the machine has such a file system; the next call replaces the file. The
/// folder also has the files that shipped cases name.
std::filesystem::path file_of_bytes(const std::uint8_t* data, std::size_t size,
                                    std::string_view name);

/// Throws std::logic_error, which is a finding, if `holds` is false; `what` is its message.
void require(bool holds, const char* what);

/// Calls `read`. Returns false if it refuses the file with an Error(kBadInput). Any other exception
/// is a finding.
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

/// Calls `use` for a file that was accepted. Returns false if it throws an Error. Any other
/// exception is a finding.
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
