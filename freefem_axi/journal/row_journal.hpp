// A journal stores the finished rows of a running tabulation on disk, so that no row is lost or
// computed twice. Beside TABLE.csv there is TABLE.csv.rows for the tabulation on this machine, and
// a TABLE.csv.rows.WRITER for each process of a cluster. Each file has one writer, because some
// file systems do not support locks. A change must keep that journals are only appended to;
// row_record.hpp reads all of them together.
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/freefem_axi/journal/journal_line.hpp"

namespace viscontact::freefem_axi {

/// The path TABLE.csv.rows, or TABLE.csv.rows.WRITER if there is a writer.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// A journal that is open for appending. One process at a time has it.
class RowJournal {
 public:
  /// Opens the file, or makes it. Throws Error(kBadInput) if it cannot be written or if another
  /// process has locked it.
  RowJournal(std::filesystem::path path, std::string tabulation_hash);

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
