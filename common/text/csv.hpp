// CSV files as Viscontact writes them (docs/file-formats.md): lines "# key: value", a header line,
// and rows of finite numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
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

/// The numbers in the requested columns, each of them finite, or nothing if its field is empty.
template <std::size_t columns>
struct CsvRow {
  std::array<std::optional<double>, columns> fields;  ///< in the order of the requested columns
  int line = 0;                                       ///< from 1
};

template <std::size_t columns>
struct CsvFile {
  CsvComments comments;
  std::set<std::string> contradictions;  ///< keys that occur twice with different values
  std::vector<CsvRow<columns>> rows;
};

/// Leaves out the commas that spreadsheets add at the end of the lines. If a key occurs twice, the
/// last value counts. Keys whose values differ are added to `contradictions`, if not null.
CsvComments read_csv_comments(const std::string& text,
                              std::set<std::string>* contradictions = nullptr);

/// The lines "# key: value". Keys and values must have no line ends.
std::string write_csv_comments(const CsvComments& comments);

/// Throws Error(kBadInput), which names file and key, if the value is missing or no finite number.
double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file);

/// The texts between the commas, unchanged, also quotation marks. An empty line has one field.
std::vector<std::string> csv_fields(const std::string& line);

/// The text as messages show it: at most its first 60 bytes, followed by "..." if it is longer, and
/// with "?" in place of each control character.
std::string shortened(const std::string& text);

/// The first line that is neither empty nor a comment.
struct CsvHeader {
  std::vector<std::string> names;  ///< without blanks around
  int line = 0;                    ///< from 1; after the last one if there is none
};
/// `text` may begin with a byte order mark.
CsvHeader csv_header(const std::string& text);

/// Does the work of read_csv() below, with the same errors, for a number of columns that is known
/// only at run time. `text` is the content of `file`. Calls `add_row` for each row with one field
/// for each of `names` and with the number of the line, from 1. When an error is thrown, rows above
/// the faulty one may have been added. Throws what `add_row` throws, too.
void read_csv_rows(
    std::string text, const std::string& file, std::span<const std::string> names,
    std::size_t required,
    const std::function<void(std::span<const std::optional<double>> fields, int line)>& add_row);

/// Reads the columns `names`; the file may have them in another order, and further columns. The
/// first `required` columns must exist; if another column is missing, its fields are empty. Blank
/// lines after the last row are ignored. A file without rows is accepted.
///
/// Throws Error(kBadInput) with the file, and with the line if the fault is in one line, if the
/// file cannot be read; if it has no header line, a column twice, or not all required columns; if a
/// row has more or fewer fields than the header line; if a field is neither empty nor a finite
/// number; if a line is too long for the library. If there is a line "# rows: N", the file must
/// also have N rows and end with a line break, because it was cut short otherwise.
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

/// The number in the requested column `i`. Throws Error(kBadInput) if the field is empty.
template <std::size_t columns>
double required_field(const CsvRow<columns>& row, const std::array<std::string, columns>& names,
                      std::size_t i, const std::string& file) {
  assert(i < columns);
  if (!row.fields[i])
    throw_bad_input({file, row.line, names[i]}, names[i] + " is empty; it must be a number");
  return *row.fields[i];
}

}  // namespace viscontact
