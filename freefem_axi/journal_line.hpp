// The lines of a journal: a row that is finished, or one that failed.
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "viscontact/lubrication/force_table.hpp"

namespace viscontact {

/// What tells the rows of a tabulation apart.
struct GridPoint {
  double gap = 0;                 ///< q [L]
  double reference_velocity = 0;  ///< u0 [L/T]
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy takes the 0 that <=> is compared with for a pointer
  friend auto operator<=>(const GridPoint&, const GridPoint&) = default;
};

struct FinishedRow {
  ForceTableRow row;
  std::string freefem_version;  ///< of the FreeFEM that computed it
};

struct FailedRow {
  GridPoint point;
  std::string reason;  ///< one line, for the user
};

using JournalEntry = std::variant<FinishedRow, FailedRow>;

struct JournalLine {
  std::string tabulation_hash;
  JournalEntry entry;
};

/// The line, with its end. It closes with a checksum: what a crash, a full disk or two writers at
/// once left of a line is not taken for one.
std::string write_journal_line(const JournalLine& line);

/// What a line (without its end) says, if it is whole.
std::optional<JournalLine> read_journal_line(std::string_view line);

}  // namespace viscontact
