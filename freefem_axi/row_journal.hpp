// Finished rows on disk while a tabulation runs, so that none is lost or computed twice.
//
// Beside TABLE.csv stand TABLE.csv.rows, of the tabulation on this machine, and one
// TABLE.csv.rows.WRITER for each process of a cluster: a file has one writer, whatever the file
// system thinks of locks. Journals are only ever appended to. All are read together (row_record.hpp).
#pragma once

#include <filesystem>
#include <string>

#include "viscontact/common/files/descriptor.hpp"
#include "viscontact/freefem_axi/journal_line.hpp"

namespace viscontact {

/// TABLE.csv.rows, or TABLE.csv.rows.WRITER.
std::filesystem::path journal_path(const std::filesystem::path& table_path,
                                   const std::string& writer = {});

/// The end of a journal, to which one process at a time appends.
class RowJournal {
 public:
  /// Opens or makes the file. Throws Error(kBadInput) if it cannot be written or another process
  /// holds it.
  RowJournal(std::filesystem::path path, std::string tabulation_hash);

  /// Appends a row, or why it failed; on disk when this returns. Throws Error(kBadInput) if the
  /// disk does not take it.
  void append(const JournalEntry& entry);

 private:
  std::filesystem::path path_;
  std::string hash_;
  Descriptor file_;
  bool at_line_start_ = true;  ///< false behind a line that a crash or a full disk tore
};

}  // namespace viscontact
