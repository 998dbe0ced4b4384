// The lines of a journal, each for a finished or a failed row. Numbers are in the units of the
// case. A change must keep journals of interrupted tabulations readable.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "viscontact/lubrication/force_table.hpp"

namespace viscontact::freefem_axi {

/// The gap and velocity of a row, by which the rows of a tabulation are told apart.
struct GridPoint {
  double gap = 0;                 ///< q [L]
  double reference_velocity = 0;  ///< u0 [L/T]
  // clang-tidy takes the 0 that <=> is compared with for a pointer.
  // NOLINTNEXTLINE(modernize-use-nullptr)
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

struct FinishedRow {
  lubrication::ForceTableRow row;
  std::string freefem_version;  ///< version of the FreeFEM that computed it
};

struct FailedRow {
  GridPoint point;
  std::string reason;  ///< one line, for the user
};

using JournalEntry = std::variant<FinishedRow, FailedRow>;

/// A line of a journal.
struct JournalLine {
  /// Hash of the tabulation that the row belongs to (tabulation.hpp).
  std::string tabulation_hash;
  JournalEntry entry;
};

/// The text of the line with its line end. The line contains a checksum, so that the remains of a
/// line after a crash, a full disk or two simultaneous writers are not read as a row.
std::string write_journal_line(const JournalLine& line);

/// Reads a line (without its line end). Returns nothing if the line is incomplete or damaged.
std::optional<JournalLine> read_journal_line(std::string_view line);

}  // namespace viscontact::freefem_axi
