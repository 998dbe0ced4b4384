// CSV files as Viscontact writes them (docs/file-formats.md): lines "# key: value", a header line,
// and rows of finite numbers, each in the unit of its column. All readers of tables, trajectories
// and particles use this file; what is thrown is Error(kBadInput) with the file. A change must keep
// published files readable.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"

namespace viscontact {

/// The lines "# key: value" of a file, sorted by key; a value may be empty.
using CsvComments = std::map<std::string, std::string>;

/// A row: the fields of the requested columns as numbers (nothing for an empty field), and the
/// number of its line in the file.
template <std::size_t columns>
struct CsvRow {
  std::array<std::optional<double>, columns> fields;  ///< in the order of the requested columns
  int line = 0;                                       ///< number of the line, from 1
};

/// The content of a CSV file, of whose columns only the requested ones are kept.
template <std::size_t columns>
struct CsvFile {
  CsvComments comments;                  ///< the lines at its head
  std::set<std::string> contradictions;  ///< keys that occur twice with different values
  std::vector<CsvRow<columns>> rows;     ///< in the order of the file
};

/// Reads the lines "# key: value" of `text`, without the commas at their end that spreadsheets add;
/// other lines are skipped, and nothing is thrown. If a key occurs twice, the last value counts; if
/// values differ, `contradictions` (nullptr: not asked for) gets the key.
CsvComments read_csv_comments(const std::string& text,
                              std::set<std::string>* contradictions = nullptr);

/// The lines "# key: value" for `comments`; empty if there are none. Line ends are not checked.
std::string write_csv_comments(const CsvComments& comments);

/// The value of a comment that must be a finite number. Throws Error(kBadInput), which names the
/// file and the key, if it is missing or is not a number.
double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file);

/// The fields of a line without quotation marks, unchanged. There is one field more than there are
/// commas, so that an empty line has one.
std::vector<std::string> csv_fields(const std::string& line);

/// The text for a message: if it has more than 60 bytes, the first 60 of them and "...", and "?"
/// for each control character.
std::string shortened(const std::string& text);

/// The header line of a CSV file: the first one that is neither empty nor a comment.
struct CsvHeader {
  std::vector<std::string> names;  ///< of the columns, without blanks around them
  int line = 0;  ///< number of the line, from 1; after the last one if there is none
};
/// The header line of `text`, the content of a file, which may begin with a byte order mark.
/// Nothing is thrown; a text without a header line has no names.
CsvHeader csv_header(const std::string& text);

/// As read_csv below, and with its errors, for a number of columns that is known at run time:
/// `text` is the content of the file, `file` its name in messages. Calls `add_row` with the fields
/// of each row, as many as `names` (at least one), and the number of its line, from 1; rows above a
/// faulty one may have been added when the error is thrown. Throws what `add_row` throws, too.
void read_csv_rows(
    std::string text, const std::string& file, std::span<const std::string> names,
    std::size_t required,
    const std::function<void(std::span<const std::optional<double>> fields, int line)>& add_row);

/// Reads the columns `names` of a CSV file, in this order. The file may have its columns in another
/// order, and further columns. The first `required` columns must exist; if another column is
/// missing, its fields are empty. Blank lines after the last row are ignored.
///
/// Throws Error(kBadInput) with the file, and the line if it is one, if the file cannot be read,
/// has no header line, the same column twice or a required one not at all; for a row with more or
/// fewer fields than the header line, a line too long for the library, and a field that is neither
/// empty nor a finite number; and if a line "# rows: N" says another number of rows or the last
/// line has no line break (the file was cut short). A file without rows is right.
template <std::size_t columns>
CsvFile<columns> read_csv(const std::filesystem::path& path,
                          const std::array<std::string, columns>& names, std::size_t required) {
  CsvFile<columns> result;
  const std::string text = read_file(path);
  result.comments = read_csv_comments(text, &result.contradictions);
  read_csv_rows(text, path.string(), names, required,
                [&](std::span<const std::optional<double>> fields, int line) {
                  auto& row = result.rows.emplace_back();
                  std::copy_n(fields.begin(), columns, row.fields.begin());
                  row.line = line;
                });
  return result;
}

/// The number in column `i` < `columns` of a row. Throws Error(kBadInput) with file and line if the
/// field is empty.
template <std::size_t columns>
double required_field(const CsvRow<columns>& row, const std::array<std::string, columns>& names,
                      std::size_t i, const std::string& file) {
  if (!row.fields[i])
    throw_bad_input({file, row.line}, names[i] + " is empty; it must be a number");
  return *row.fields[i];
}

}  // namespace viscontact
