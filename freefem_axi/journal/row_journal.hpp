// A journal is a file that stores the finished and failed rows of a table while FreeFEM computes
// the others, so that no row is lost or computed twice if the program is interrupted. Beside
// TABLE.csv there is TABLE.csv.rows for a computation on this machine, and a TABLE.csv.rows.WRITER
// for each process of a cluster. Each file has one writer, because some file systems do not support
// locks. A line is one row; its numbers have the units of the table. Readers skip a damaged line;
// if a journal cannot be written, Error(kBadInput) is thrown. tabulate.cpp writes journals,
// row_record.cpp reads them, and pipeline/tabulate/ names them. A change must only append to a
// journal, and must keep journals of interrupted runs readable.
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

/// The text of the line for `entry`, with its line end. `hash`, a word without blanks, is
/// TablePlan::hash of the table; numbers must be finite (asserted). The line contains a checksum,
/// by which readers find a line that a crash, a full disk or a second writer has damaged.
std::string write_journal_line(const std::string& hash, const JournalEntry& entry);

/// Reads from a line, without its line end, TablePlan::hash of the table to which the row belongs.
/// Returns nothing if the line is incomplete or damaged.
std::optional<std::string> hash_of_journal_line(std::string_view line);

/// Reads the row or the failure in a line, without its line end, for a table of any hash. `shape`
/// says how many numbers the row must have. Returns nothing if the line is incomplete or damaged,
/// or has fewer numbers.
std::optional<JournalEntry> read_journal_line(std::string_view line, const RowShape& shape);

/// The path of the journal beside the table at `table_path`: TABLE.csv.rows, or
/// TABLE.csv.rows.WRITER if the name `writer` is not empty.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// The name "NUMBER-of-COUNT.HOST.PROCESS" of this process as the writer of a journal. This process
/// computes the part `number` of the `count` parts into which the rows of a table are divided; 0 <=
/// number < count is not checked. HOST and PROCESS, the process id, make the name unique among all
/// running processes.
std::string writer_name(std::size_t number, std::size_t count);

/// True for the names that writer_name() makes. A file TABLE.csv.rows.NAME with another NAME is not
/// a journal but a file of the user, which must not be read or removed.
bool is_writer_name(const std::string& name);

/// A journal that is open for appending and locked, so that only one process at a time can open it.
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
  /// False if the last line of the file is incomplete, because of a crash or a full disk. append()
  /// then first writes a line end.
  bool at_line_start_ = true;
};

}  // namespace viscontact::freefem_axi
