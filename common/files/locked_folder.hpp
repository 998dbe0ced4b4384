// A folder that only one process at a time may write into: that of a run.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Locks a folder against other processes that lock it in the same way, until this object is
/// destroyed. A folder that does not exist is made, and removed at the end if it is still empty.
/// The lock is on the folder itself, so that no lock file is left. It is not an error if the file
/// system has no locks.
class LockedFolder {
 public:
  /// Throws Error(kBadInput), which names the path, if the folder cannot be made, or if another
  /// process has locked it; then its message ends with `message`.
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
