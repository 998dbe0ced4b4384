// The rows that a table of forces or of motions lacks because they could not be computed. The file
// of the table names each of them in a line "# failed row, gap 0.01, velocity -1: REASON"
// (docs/file-formats.md). A change must keep this form, because `fit` warns of these rows.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace viscontact::lubrication {

/// The name of each failed row, "gap 0.01, velocity -1" with all digits, and the reason.
using FailedRows = std::map<std::string, std::string>;

/// Beginning of the key of such a line; the name of the row follows.
inline constexpr std::string_view kFailedRow = "failed row, ";

/// Adds a line for each of these rows to `comments`, which has the lines "# key: value" of a table.
inline void add_failed_rows(std::map<std::string, std::string>& comments,
                            const FailedRows& failed) {
  for (const auto& [name, reason] : failed) comments[std::string(kFailedRow) + name] = reason;
}

/// The rows that `comments`, the lines "# key: value" of a table, name.
inline FailedRows failed_rows_in(const std::map<std::string, std::string>& comments) {
  FailedRows failed;
  for (const auto& [key, value] : comments)
    if (key.starts_with(kFailedRow)) failed[key.substr(kFailedRow.size())] = value;
  return failed;
}

}  // namespace viscontact::lubrication
