// Merges the rows of the journals with those of the table, and removes what the table contains.
#include "viscontact/freefem_axi/journal/row_record.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/freefem_axi/journal/row_journal.hpp"

namespace viscontact::freefem_axi {
namespace {

namespace fs = std::filesystem;

/// In alphabetical order.
std::vector<fs::path> journals_of(const fs::path& table_path) {
  const fs::path own = journal_path(table_path);
  std::vector<fs::path> journals;
  std::error_code no_folder;
  for (const auto& entry :
       fs::directory_iterator(own.has_parent_path() ? own.parent_path() : ".", no_folder)) {
    const std::string name = entry.path().filename().string();
    const std::string stem = own.filename().string() + ".";
    if (name == own.filename() ||
        (name.starts_with(stem) && is_writer_name(name.substr(stem.size()))))
      journals.push_back(entry.path());
  }
  std::ranges::sort(journals);
  return journals;
}

/// Calls `use` with each complete line, without its line end. A journal that another process
/// removes at the same time counts as empty; other failures to read throw Error(kBadInput).
template <class Use>
void for_each_line(const fs::path& journal, const Use& use) {
  std::string text;
  try {
    text = read_file(journal);
  } catch (const Error&) {
    std::error_code refused;
    if (fs::status(journal, refused).type() != fs::file_type::not_found) throw;
  }
  for (std::size_t start = 0, end = 0; (end = text.find('\n', start)) != std::string::npos;
       start = end + 1)
    use(std::string_view(text).substr(start, end - start));
}

}  // namespace

RowRecord read_row_record(const fs::path& table_path, const TablePlan& plan) {
  RowRecord record;
  for (const auto& journal : journals_of(table_path))
    for_each_line(journal, [&](std::string_view line) {
      if (hash_of_journal_line(line) != plan.hash) return;
      const auto entry = read_journal_line(line, plan.shape);
      if (!entry) return;
      if (const auto* finished = std::get_if<FinishedRow>(&*entry))
        record.finished.insert({finished->point, *finished});
      else if (const auto* failed = std::get_if<FailedRow>(&*entry))
        record.failed[failed->point] = failed->reason;
    });
  // The table must be read last, because the process that writes it then removes the journals: if
  // the table were read before and the journals after that, its rows would be missing.
  auto in_table = plan.read(table_path);
  record.finished.merge(in_table.finished);
  record.failed.merge(in_table.failed);
  std::erase_if(record.failed,
                [&](const auto& failed) { return record.finished.contains(failed.first); });
  return record;
}

std::vector<RowPoint> missing_points(const RowRecord& record, const std::vector<RowPoint>& points) {
  std::vector<RowPoint> missing;
  std::ranges::copy_if(points, std::back_inserter(missing),
                       [&](const RowPoint& point) { return !record.finished.contains(point); });
  return missing;
}

std::vector<std::string> failures_of(const RowRecord& record, const std::vector<RowPoint>& points) {
  std::vector<std::string> reasons;
  for (const auto& point : points)
    if (const auto failed = record.failed.find(point); failed != record.failed.end())
      reasons.push_back(failed->second);
  return reasons;
}

void remove_journals(const fs::path& table_path, const std::string& hash) {
  for (const auto& journal : journals_of(table_path)) {
    // The lock is held while the journal is read and removed. Another process that has opened the
    // file and waits for the lock then notices that the file was removed or replaced, and opens the
    // new one (open_and_lock() in common/files/locks.hpp).
    const Descriptor file(::open(journal.c_str(), O_RDWR | O_CLOEXEC));
    if (file.get() < 0) continue;
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) continue;
    std::string others;
    bool has_ours = false;
    for_each_line(journal, [&](std::string_view line) {
      const auto owner = hash_of_journal_line(line);
      if (owner == hash)
        has_ours = true;
      else if (owner)
        others += std::string(line) + "\n";
    });
    if (others.empty())
      remove_file(journal);
    else if (has_ours)
      write_file(journal, others);
  }
}

}  // namespace viscontact::freefem_axi
