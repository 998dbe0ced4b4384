// Files that only one process at a time may append to (the journal of a tabulation or sweep), and
// folders that only one process at a time may write into (that of a run). app/, freefem_axi/,
// particles/, rolling/, sweep/ and swimmer/ use them. If another process holds the lock, or a call
// of the system fails, Error(kBadInput) with the path is thrown. Where the file system has no
// locks, two processes do not notice each other. Texts and messages are any bytes. A change must
// keep that a text is at the end of the file, in one piece, when append_to() returns.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Opens a file for reading and appending, makes it if it does not exist, and locks it against
/// other processes that lock it in the same way, until it is closed. Throws Error(kBadInput), which
/// names the path, if the file cannot be opened, or if another process has locked it; the text of
/// the error is then the path and `message`. It is not an error if the file system has no locks.
Descriptor open_and_lock(const std::filesystem::path& path, const std::string& message);

/// Writes the whole text at the end of `file`, which open_and_lock() must have opened (not
/// checked). `path` is the file's path, for messages. Throws Error(kBadInput), which names the
/// path, if the text cannot be written; a part of it may then be in the file.
void append_to(const Descriptor& file, std::string_view text, const std::filesystem::path& path);

/// Flushes the content of the file to disk. `path` is the file's path, for messages. Throws
/// Error(kBadInput), which names the path, if the disk reports an error.
void sync_file(const Descriptor& file, const std::filesystem::path& path);

/// Locks a folder against other processes that lock it in the same way, until this object is
/// destroyed. A folder that does not exist is made, and removed at the end if it is still empty.
/// The lock belongs to the folder itself and not to a file in it, so that no such file is left. It
/// is not an error if the file system has no locks.
class LockedFolder {
 public:
  /// Throws Error(kBadInput), which names the path, if the folder cannot be made, or if another
  /// process, or another object of this one, has locked it; the text of the error is then the path
  /// and `message`. A folder that exists but cannot be opened is no error here; the error comes
  /// when a file in it is written.
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
