#include "viscontact/common/files/locked_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

LockedFolder::LockedFolder(std::filesystem::path path, const std::string& held)
    : path_(std::move(path)) {
  std::error_code said_below;
  made_ = !std::filesystem::exists(path_, said_below) && !said_below;
  make_folder(path_);
  lock_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // What cannot be opened or locked is no reason to compute nothing; whether it can be written shows soon.
  if (lock_.get() >= 0 && ::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw_bad_input({path_.string()}, held);
}

LockedFolder::~LockedFolder() {
  if (!made_) return;
  std::error_code not_empty;
  std::filesystem::remove(path_, not_empty);
}

}  // namespace viscontact
