// The rows that a table lacks because they could not be computed. Its file names each of them in a
// line "# failed row, gap 0.01, velocity -1: REASON" (docs/file-formats.md).
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace viscontact::lubrication {

/// The rows by their names, "gap 0.01, velocity -1" with all digits, and the reason of each.
using FailedRows = std::map<std::string, std::string>;

/// How the keys of these lines begin; the name of the row follows.
inline constexpr std::string_view kFailedRow = "failed row, ";

/// Adds the lines of these rows to `comments`, the lines "# key: value" of a table by their keys.
inline void add_failed_rows(std::map<std::string, std::string>& comments,
                            const FailedRows& failed) {
  for (const auto& [name, reason] : failed) comments[std::string(kFailedRow) + name] = reason;
}

/// The rows that the lines of a table name.
inline FailedRows failed_rows_in(const std::map<std::string, std::string>& comments) {
  FailedRows failed;
  for (const auto& [key, value] : comments)
    if (key.starts_with(kFailedRow)) failed[key.substr(kFailedRow.size())] = value;
  return failed;
}

}  // namespace viscontact::lubrication
