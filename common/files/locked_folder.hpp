// A folder that one process at a time writes into.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/files/descriptor.hpp"

namespace viscontact {

/// Holds a folder against other processes that do the same, until it is destroyed. A folder that was not there is made, and taken away at the end if
/// nothing was put into it. No file is left: the lock is on the folder itself. (A file system without locks is no error.)
class LockedFolder {
 public:
  /// Throws Error(kBadInput) naming the path: "... `held`" if another process holds it, or if it cannot be made.
  LockedFolder(std::filesystem::path path, const std::string& held);
  ~LockedFolder();
  LockedFolder(const LockedFolder&) = delete;
  LockedFolder& operator=(const LockedFolder&) = delete;

 private:
  std::filesystem::path path_;
  bool made_ = false;
  Descriptor lock_;
};

}  // namespace viscontact
