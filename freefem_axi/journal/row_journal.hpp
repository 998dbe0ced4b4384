// A journal stores the finished rows of a running tabulation on disk, so that no row is lost or
// computed twice. Beside TABLE.csv there is TABLE.csv.rows for the tabulation on this machine, and
// a TABLE.csv.rows.WRITER for each process of a cluster. Each file has one writer, because some
// file systems do not support locks. tabulate.hpp writes journals, and row_record.hpp reads all of
// them together. A change must only append to a journal, so that rows are safe.
//
// A line is a finished or a failed row, with numbers in the units of the table's plan. Journals of
// interrupted tabulations must stay readable.
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

/// The text of the line with its line end. `hash` is that of the row's TablePlan. The line contains
/// a checksum, so that the remains of a line after a crash, a full disk or two simultaneous writers
/// are not read as a row.
std::string write_journal_line(const std::string& hash, const JournalEntry& entry);

/// The hash of the table that a line (without its line end) belongs to. Nothing if the line is
/// incomplete or damaged.
std::optional<std::string> hash_of_journal_line(std::string_view line);

/// Reads a line, without its line end, of a table whose rows have this shape. Nothing if the line
/// is incomplete or damaged.
std::optional<JournalEntry> read_journal_line(std::string_view line, const RowShape& shape);

/// The path TABLE.csv.rows, or TABLE.csv.rows.WRITER if there is a writer.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// The name "NUMBER-of-COUNT.HOST.PROCESS" of this process as the writer of a journal, for the task
/// `number` among `count` tasks. No two processes that run at the same time have the same name.
std::string writer_name(std::size_t number, std::size_t count);

/// True for the names that writer_name() makes. Other files whose names begin like that of a
/// journal belong to the user, and are left alone.
bool is_writer_name(const std::string& name);

/// A journal that is open for appending. One process at a time has it.
class RowJournal {
 public:
  /// Opens the file, or makes it, for rows of the TablePlan with this hash. Throws Error(kBadInput)
  /// if the file cannot be written or if another process has locked it.
  RowJournal(std::filesystem::path path, std::string hash);

  /// Appends a finished or failed row, which is on disk when the function returns. Throws
  /// Error(kBadInput) if it cannot be written.
  void append(const JournalEntry& entry);

 private:
  std::filesystem::path path_;
  std::string hash_;
  Descriptor file_;
  /// False after a line that a crash or a full disk left incomplete.
  bool at_line_start_ = true;
};

}  // namespace viscontact::freefem_axi
