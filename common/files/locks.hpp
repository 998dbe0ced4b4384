// Files that only one process at a time may append to, and folders that only one process at a time
// may write into. Where the file system has no locks, two processes do not notice each other.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Opens a file for reading and appending, makes it if it does not exist, and locks it (flock)
/// against other processes that lock it in the same way, until it is closed. Throws
/// Error(kBadInput), which names the path, if the file cannot be opened, and with the words
/// `message` if another process has locked it.
Descriptor open_and_lock(const std::filesystem::path& path, const std::string& message);

/// Writes the whole text at the end of `file`, which open_and_lock(path) has opened. If that fails,
/// Error(kBadInput) is thrown, and a part of it may be in the file.
void append_to(const Descriptor& file, std::string_view text, const std::filesystem::path& path);

/// Flushes the file at `path` to disk. Throws Error(kBadInput) if the disk reports an error.
void sync_file(const Descriptor& file, const std::filesystem::path& path);

/// Locks a folder against other processes that lock it in the same way, until this object is
/// destroyed. A folder that does not exist is made, and removed at the end if it is still empty.
/// The lock belongs to the folder itself, so that no file is left.
class LockedFolder {
 public:
  /// Throws Error(kBadInput), which names the path, if the folder cannot be made, and with the
  /// words `message` if another process, or another object of this one, has locked it. A folder
  /// that cannot be opened is an error only when a file in it is written.
  LockedFolder(std::filesystem::path path, const std::string& message);
  ~LockedFolder();
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

 private:
  std::filesystem::path path_;
  bool made_ = false;
  Descriptor lock_;
};

}  // namespace viscontact
