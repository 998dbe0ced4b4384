#include "freefem_axi/row_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/error.hpp"
#include "common/file.hpp"

namespace viscontact {
namespace {

[[noreturn]] void throw_not_written(const std::filesystem::path& path, int code) {
  throw_bad_input({path.string()},
                  fmt::format("cannot be written ({}); finished rows are kept, the same command "
                              "goes on from there",
                              std::strerror(code)));
}

/// True if the descriptor is what stands at `path`: the process that held the journal may have removed it
/// while we waited for it to be opened.
bool is_still_at(int file, const std::filesystem::path& path) {
  struct stat opened = {};
  struct stat there = {};
  return ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &there) == 0 &&
         opened.st_dev == there.st_dev && opened.st_ino == there.st_ino;
}

Descriptor open_and_lock(const std::filesystem::path& path) {
  for (;;) {
    Descriptor file(::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (file.get() < 0) throw_not_written(path, errno);
    // A file system without locks is no reason to compute nothing.
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      throw_bad_input(
          {path.string()},
          "is held by another tabulation of the same table; wait for it, or write elsewhere");
    if (is_still_at(file.get(), path)) return file;
  }
}

bool ends_with_line_end(int file) {
  const off_t size = ::lseek(file, 0, SEEK_END);
  char last = '\n';
  return size <= 0 || (::pread(file, &last, 1, size - 1) == 1 && last == '\n');
}

}  // namespace

std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer) {
  return table_path.string() + (writer.empty() ? ".rows" : ".rows." + writer);
}

RowJournal::RowJournal(std::filesystem::path path, std::string tabulation_hash)
    : path_(std::move(path)), hash_(std::move(tabulation_hash)) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  file_ = open_and_lock(path_);
  sync_folder_of(path_);
  at_line_start_ = ends_with_line_end(file_.get());
}

void RowJournal::append(const JournalEntry& entry) {
  const std::string line = (at_line_start_ ? "" : "\n") + write_journal_line({hash_, entry});
  at_line_start_ = false;
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t written = ::write(file_.get(), rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw_not_written(path_, errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(file_.get()) != 0) throw_not_written(path_, errno);
  at_line_start_ = true;
}

}  // namespace viscontact
