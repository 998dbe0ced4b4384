// A journal is a file that stores the finished and failed rows of a table while FreeFEM computes
// the others, so that no row is lost or computed twice if the program is interrupted. Beside
// TABLE.csv there is TABLE.csv.rows for a computation on this machine, and a TABLE.csv.rows.WRITER
// for each process of a cluster. Each file has one writer, because some file systems do not support
// locks. A line is one row; its numbers have the units of the table. Readers pass over a line that
// is damaged; a journal that cannot be written throws Error(kBadInput). Used by tabulate.cpp
// (writes), row_record.cpp (reads) and pipeline/tabulate/. A change must only append to a journal,
// and must keep journals of interrupted runs readable.
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

/// What a line of the journal records: a row of the table, or the failure to compute it.
using JournalEntry = std::variant<FinishedRow, FailedRow>;

/// The text of a line with its line end. `hash` is TablePlan::hash of the table. The line contains
/// a checksum, by which a line that a crash, a full disk or a second writer has damaged is found.
std::string write_journal_line(const std::string& hash, const JournalEntry& entry);

/// The hash in a line, which is given without its line end: TablePlan::hash of the table to which
/// the row belongs. Nothing if the line is incomplete or damaged.
std::optional<std::string> hash_of_journal_line(std::string_view line);

/// Reads a line, which is given without its line end. `shape` says how many numbers its row has.
/// Nothing if the line is incomplete or damaged, or has fewer numbers.
std::optional<JournalEntry> read_journal_line(std::string_view line, const RowShape& shape);

/// The path TABLE.csv.rows, or TABLE.csv.rows.WRITER if there is a writer.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// The name "NUMBER-of-COUNT.HOST.PROCESS" of this process as the writer of a journal. It computes
/// part `number`, from 0 (not checked), of the `count` parts into which the rows of a table are
/// divided. HOST and PROCESS, the process id, make the name unique among all running processes.
std::string writer_name(std::size_t number, std::size_t count);

/// True for the names that writer_name() makes. A file TABLE.csv.rows.NAME with another NAME is not
/// a journal but a file of the user, which must not be read or removed.
bool is_writer_name(const std::string& name);

/// A journal that is open for appending and locked: one process at a time can open it.
class RowJournal {
 public:
  /// Opens the file at `path`, or makes it and its folder, for rows of the table whose
  /// TablePlan::hash is `hash`. Throws Error(kBadInput) if the file cannot be written or if another
  /// process has locked it.
  RowJournal(std::filesystem::path path, std::string hash);

  /// Appends a finished or failed row. It is on disk when the function returns. Throws
  /// Error(kBadInput) if the row cannot be written.
  void append(const JournalEntry& entry);

 private:
  std::filesystem::path path_;
  std::string hash_;
  Descriptor file_;
  /// False if the last line of the file is incomplete, after a crash or on a full disk. append()
  /// then ends it first.
  bool at_line_start_ = true;
};

}  // namespace viscontact::freefem_axi
