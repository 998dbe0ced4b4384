// The lock is an flock(2) on the folder itself (locked_folder.hpp).
#include "viscontact/common/files/locked_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

LockedFolder::LockedFolder(std::filesystem::path path, const std::string& message)
    : path_(std::move(path)) {
  std::error_code said_below;
  made_ = !std::filesystem::exists(path_, said_below) && !said_below;
  make_folder(path_);
  lock_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder that cannot be opened or locked (on a file system without locks, for example) is not
  // an error here. If no file can be written into it, the error comes when the first file is
  // written.
  if (lock_.get() >= 0 && ::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw_bad_input({path_.string()}, message);
}

LockedFolder::~LockedFolder() {
  if (!made_) return;
  std::error_code not_empty;
  std::filesystem::remove(path_, not_empty);
}

}  // namespace viscontact
