// Finished rows on disk while a tabulation runs, so that none is computed twice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/descriptor.hpp"
#include "fitting/force_table.hpp"

namespace viscontact {

/// A file beside the table to which each finished row is appended and flushed. Rows of another
/// tabulation (by its hash) and a line that a crash left half-written are dropped when it is
/// opened. One process at a time may hold it.
class RowJournal {
 public:
  /// Opens or makes the journal. Throws Error(kBadInput) if it cannot be written or another process
  /// holds it.
  RowJournal(std::filesystem::path path, std::string tabulation_hash);

  /// The finished row of that gap and velocity, if there is one.
  std::optional<ForceTableRow> find(double gap, double reference_velocity) const;

  /// Appends a row, on disk when this returns. Throws Error(kBadInput) if the disk does not take
  /// it.
  void append(const ForceTableRow& row);

 private:
  std::filesystem::path path_;
  std::string hash_;
  std::vector<ForceTableRow> rows_;
  Descriptor file_;
};

}  // namespace viscontact
