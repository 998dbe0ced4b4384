// One call writes the new lines over the foot, followed by the foot again.
#include "viscontact/common/files/growing_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {
namespace {

/// The reason is that of errno; `action` is a participle such as "read".
[[noreturn]] void throw_cannot_be(const char* action, const std::filesystem::path& path) {
  throw_bad_input({path.string()}, "cannot be {} ({})", action, std::strerror(errno));
}

}  // namespace

GrowingFile::GrowingFile(std::filesystem::path path, std::string_view head, std::string foot)
    : path_(std::move(path)), foot_(std::move(foot)) {
  append(head);
}

void GrowingFile::check(const FileEnd& end) const {
  const Descriptor file(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status = {};
  if (file.get() < 0 || ::fstat(file.get(), &status) != 0) throw_cannot_be("read", path_);
  const auto line = end.last_line + "\n";
  std::string found(line.size(), '\0');
  if (end.bytes < line.size() || static_cast<std::uint64_t>(status.st_size) < end.bytes ||
      ::pread(file.get(), found.data(), found.size(),
              static_cast<off_t>(end.bytes - line.size())) != std::ssize(found) ||
      found != line)
    throw_bad_input({path_.string()}, "does not have the lines that the run has written into it");
}

void GrowingFile::resume(const FileEnd& end) {
  check(end);
  file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC));
  if (file_.get() < 0 || ::ftruncate(file_.get(), static_cast<off_t>(end.bytes)) != 0)
    throw_cannot_be("written", path_);
  end_ = end;
  waiting_.clear();
  write_at(end.bytes, foot_);
}

void GrowingFile::append(std::string_view lines) {
  if (lines.empty()) return;
  assert(lines.back() == '\n');
  waiting_ += lines;
  end_.bytes += lines.size();
  const auto last = lines.substr(0, lines.size() - 1);
  end_.last_line = last.substr(last.rfind('\n') + 1);  // npos + 1 = 0: there is only one line
  constexpr std::size_t kMostWaiting = std::size_t{1} << 16U;  // bytes; 1 KiB to 1 MiB work
  if (waiting_.size() > kMostWaiting) write_waiting();
}

void GrowingFile::sync() {
  if (!waiting_.empty() || file_.get() < 0) write_waiting();
  if (::fsync(file_.get()) != 0) throw_cannot_be("written", path_);
}

void GrowingFile::write_waiting() {
  if (file_.get() < 0) {
    // The new file appears in one step, so that no reader finds only a part of its head.
    write_file(path_, waiting_ + foot_);
    file_ = Descriptor(::open(path_.c_str(), O_WRONLY | O_CLOEXEC));
    if (file_.get() < 0) throw_cannot_be("written", path_);
  } else {
    const auto place = end_.bytes - waiting_.size();
    try {
      write_at(place, waiting_ + foot_);
    } catch (const Error&) {
      // The disk has space for the foot, because it was there before.
      if (::ftruncate(file_.get(), static_cast<off_t>(place)) == 0) write_at(place, foot_);
      throw;
    }
  }
  waiting_.clear();
}

void GrowingFile::write_at(std::uint64_t place, std::string_view text) const {
  assert(file_.get() >= 0);
  if (::lseek(file_.get(), static_cast<off_t>(place), SEEK_SET) < 0 || !write_all(file_, text))
    throw_cannot_be("written", path_);
}

}  // namespace viscontact
