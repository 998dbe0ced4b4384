// Locks by flock, because freefem_axi/journal/row_record.cpp locks the same files by flock.
#include "viscontact/common/files/locks.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

/// The message says nothing of finished rows, because none have been written.
[[noreturn]] void throw_not_opened(const std::filesystem::path& path, int code) {
  throw_bad_input({path.string()}, "cannot be written ({})", std::strerror(code));
}

/// The error for a file to which rows may have been written before.
[[noreturn]] void throw_not_written(const std::filesystem::path& path, int code) {
  throw_bad_input(
      {path.string()},
      "cannot be written ({}); finished rows are kept, and the same command continues from there",
      std::strerror(code));
}

/// False if the process that had the lock has removed the file after this process opened it and
/// before this process locked it.
bool is_still_at(int file, const std::filesystem::path& path) {
  struct stat opened = {};
  struct stat there = {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

}  // namespace

Descriptor open_and_lock(const std::filesystem::path& path, const std::string& message) {
  for (;;) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (file.get() < 0) throw_not_opened(path, errno);
    // A file system without locks must not prevent the computation.
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw_bad_input({path.string()}, message);
    if (is_still_at(file.get(), path)) return file;
  }
}

void append_to(const Descriptor& file, std::string_view text, const std::filesystem::path& path) {
  assert(file.get() >= 0);
  if (!write_all(file, text)) throw_not_written(path, errno);
}

void sync_file(const Descriptor& file, const std::filesystem::path& path) {
  assert(file.get() >= 0);
  if (::fsync(file.get()) != 0) throw_not_written(path, errno);
}

LockedFolder::LockedFolder(std::filesystem::path path, const std::string& message)
    : path_(std::move(path)) {
  std::error_code said_below;
  made_ = !std::filesystem::exists(path_, said_below) && !said_below;
  make_folder(path_);
  lock_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // A folder that cannot be opened or locked (on a file system without locks, for example) is not
  // an error here. The error comes when the first file is written.
  if (lock_.get() >= 0 && ::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw_bad_input({path_.string()}, message);
}

LockedFolder::~LockedFolder() {
  if (!made_) return;
  std::error_code not_empty;
  std::filesystem::remove(path_, not_empty);
}

}  // namespace viscontact
