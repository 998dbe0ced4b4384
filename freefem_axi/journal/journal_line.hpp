// The lines of a journal (row_journal.hpp), each for a finished or a failed row. Numbers have the
// units of the table's plan. A change must keep journals of interrupted tabulations readable.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>

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

}  // namespace viscontact::freefem_axi
