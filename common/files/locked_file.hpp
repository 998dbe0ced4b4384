// A file that is appended to by one process at a time.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Opens a file for reading and appending, made if it is not there, and locks it against other processes that do the same, until it is closed. Throws
/// Error(kBadInput) that names the path: "... `held`" if another process holds the lock. (A file system without locks is no error.)
Descriptor open_and_lock(const std::filesystem::path& path, const std::string& held);

/// Writes all of the text at the end. Throws Error(kBadInput) that names the path.
void append_to(const Descriptor& file, std::string_view text, const std::filesystem::path& path);

/// Has it on disk before it returns. Throws Error(kBadInput) that names the path.
void sync_file(const Descriptor& file, const std::filesystem::path& path);

}  // namespace viscontact
