// A file that only one process at a time may append to: the journal of a tabulation or sweep. A
// change must keep that a text is at the end of the file, in one piece, when append_to returns.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Opens a file for reading and appending, makes it if it does not exist, and locks it against
/// other processes that lock it in the same way, until it is closed. Throws Error(kBadInput), which
/// names the path, if the file cannot be opened, or if another process has locked it; then the
/// error ends with `message`. It is not an error if the file system has no locks.
Descriptor open_and_lock(const std::filesystem::path& path, const std::string& message);

/// Writes the whole text at the end of the file. `path` is the file's path, for messages. Throws
/// Error(kBadInput), which names the path, if the text cannot be written.
void append_to(const Descriptor& file, std::string_view text, const std::filesystem::path& path);

/// Returns when the content of the file is on disk. Throws Error(kBadInput), which names the path,
/// if the disk reports an error.
void sync_file(const Descriptor& file, const std::filesystem::path& path);

}  // namespace viscontact
