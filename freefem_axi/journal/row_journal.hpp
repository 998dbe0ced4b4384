// A journal stores the finished and failed rows of a table while FreeFEM computes the others, so
// that no row is lost or computed twice if the program is interrupted.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/freefem_axi/journal/table_plan.hpp"

namespace viscontact::freefem_axi {

/// What a line of the journal records, in the units of the table.
using JournalEntry = std::variant<FinishedRow, FailedRow>;

/// The text of the line for `entry`, with its line end. `hash`, a word without blanks, is
/// TablePlan::hash of the table; numbers must be finite. The line contains a checksum, by which
/// readers find a line that a crash, a full disk or a second writer has damaged.
std::string write_journal_line(const std::string& hash, const JournalEntry& entry);

/// TablePlan::hash of a line without its line end; nothing if the line is incomplete or damaged.
std::optional<std::string> hash_of_journal_line(std::string_view line);

/// The row or the failure in a line, without its line end, for a table of any hash. Nothing if the
/// line is incomplete or damaged, or has fewer numbers than `shape` says.
std::optional<JournalEntry> read_journal_line(std::string_view line, const RowShape& shape);

/// The path of the journal beside the table at `table_path`: TABLE.csv.rows for a computation on
/// this machine, or TABLE.csv.rows.WRITER for each process `writer` of a cluster. Each file has one
/// writer, because some file systems do not support locks.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// The name "NUMBER-of-COUNT.HOST.PROCESS" of this process, which computes the part `number` <
/// `count` of the rows of a table. HOST and the process id make it unique among running processes.
std::string writer_name(std::size_t number, std::size_t count);

/// True for the names that writer_name() makes. A file TABLE.csv.rows.NAME with another NAME is not
/// a journal but a file of the user, which must not be read or removed.
bool is_writer_name(const std::string& name);

/// A journal that is open for appending and locked, so that only one process at a time can open it.
class RowJournal {
 public:
  /// Opens or makes the file at `path` for rows of the table with TablePlan::hash `hash`. Throws
  /// Error(kBadInput) if the file cannot be written or if another process has locked it.
  RowJournal(std::filesystem::path path, std::string hash);

  /// The row is on disk when the function returns. Throws Error(kBadInput) if it cannot be written.
  void append(const JournalEntry& entry);

 private:
  std::filesystem::path path_;
  std::string hash_;
  Descriptor file_;
  // False if the last line is incomplete, because of a crash or a full disk.
  bool at_line_start_ = true;
};

}  // namespace viscontact::freefem_axi
