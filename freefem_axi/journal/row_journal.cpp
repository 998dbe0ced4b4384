// Opens, locks and appends to a journal. A journal that cannot be written is an Error(kBadInput). A
// change must keep lines in one piece, and on disk when append() returns.
#include "viscontact/freefem_axi/journal/row_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/files/locks.hpp"

namespace viscontact::freefem_axi {
namespace {

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

std::string writer_name(std::size_t number, std::size_t count) {
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  return fmt::format("{}-of-{}.{}.{}", number, count, host.data(), ::getpid());
}

bool is_writer_name(const std::string& name) {
  return ::fnmatch("+([0-9])-of-+([0-9]).?*.+([0-9])", name.c_str(), FNM_EXTMATCH) == 0;
}

RowJournal::RowJournal(std::filesystem::path path, std::string hash)
    : path_(std::move(path)), hash_(std::move(hash)) {
  if (path_.has_parent_path()) make_folder(path_.parent_path());
  file_ = open_and_lock(
      path_, "is locked by another tabulation of the same table; wait for it, or write elsewhere");
  sync_folder_of(path_);
  at_line_start_ = ends_with_line_end(file_.get());
}

void RowJournal::append(const JournalEntry& entry) {
  const std::string line = (at_line_start_ ? "" : "\n") + write_journal_line(hash_, entry);
  at_line_start_ = false;
  append_to(file_, line, path_);
  sync_file(file_, path_);
  at_line_start_ = true;
}

}  // namespace viscontact::freefem_axi
