// CSV files as Viscontact writes them (docs/file-formats.md): lines "# key: value", a header line,
// and rows of finite numbers, each in the unit of its column. All readers of tables, trajectories
// and particles use this file. Faults of a file throw Error(kBadInput) with its name. Further
// errors and messages may be added; a change must keep published files readable.
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

/// A row of the file: the numbers in the requested columns, each of them finite, or nothing if its
/// field is empty.
template <std::size_t columns>
struct CsvRow {
  std::array<std::optional<double>, columns> fields;  ///< in the order of the requested columns
  int line = 0;                                       ///< number of the line, from 1
};

/// The content of a CSV file without the columns that were not requested.
template <std::size_t columns>
struct CsvFile {
  CsvComments comments;                  ///< all its lines "# key: value"
  std::set<std::string> contradictions;  ///< keys that occur twice with different values
  std::vector<CsvRow<columns>> rows;     ///< in the order of the file
};

/// Reads the lines "# key: value" of `text`, and leaves out the commas that spreadsheets add at
/// their end. Other lines are skipped, and nothing is thrown. If a key occurs twice, the last value
/// counts. If its values differ, the key is added to `contradictions`, unless this pointer is null.
CsvComments read_csv_comments(const std::string& text,
                              std::set<std::string>* contradictions = nullptr);

/// The lines "# key: value" for `comments`; empty if there are none. That keys and values contain
/// no line ends is not checked.
std::string write_csv_comments(const CsvComments& comments);

/// The value of a comment that must be a finite number. Throws Error(kBadInput), which names the
/// file and the key, if it is missing or is not a number.
double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file);

/// The texts between the commas of a line, unchanged; quotation marks have no special meaning.
/// There is one field more than there are commas, so that an empty line has one empty field. Throws
/// nothing.
std::vector<std::string> csv_fields(const std::string& line);

/// The text as messages show it: at most its first 60 bytes (a free choice), followed by "..." if
/// it is longer, and with "?" in place of each control character.
std::string shortened(const std::string& text);

/// The header line of a CSV file: the first one that is neither empty nor a comment.
struct CsvHeader {
  std::vector<std::string> names;  ///< names of the columns, without blanks around
  int line = 0;  ///< number of the line, from 1; after the last one if there is none
};
/// The header line of `text`, the content of a file, which may begin with a byte order mark.
/// Nothing is thrown; a text without a header line has no names.
CsvHeader csv_header(const std::string& text);

/// Does the work of read_csv() below, with the same errors, for a number of columns that is known
/// only at run time. `text` is the content of the file, and `file` its name in messages. Calls
/// `add_row` for each row with one field for each of `names` (at least one name; not checked) and
/// with the number of the line, from 1. When an error is thrown, rows above the faulty one may have
/// been added. Throws what `add_row` throws, too.
void read_csv_rows(
    std::string text, const std::string& file, std::span<const std::string> names,
    std::size_t required,
    const std::function<void(std::span<const std::optional<double>> fields, int line)>& add_row);

/// Reads the columns `names` of the CSV file at `path`; the fields of a row are in the order of
/// `names`. The file may have its columns in another order, and further columns. The first
/// `required` columns must exist; if another column is missing, its fields are empty. Blank lines
/// after the last row are ignored.
///
/// Throws Error(kBadInput) with the file, and with the line if the fault is in one line. The faults
/// are: the file cannot be read; it has no header line, a column twice, or not all required
/// columns; a row has more or fewer fields than the header line; a field is neither empty nor a
/// finite number; a line is too long for the library. If there is a line "# rows: N", the file must
/// also have N rows and end with a line break, because it was cut short otherwise. A file without
/// rows is accepted.
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

/// The number in the requested column `i`, from 0, of a row; i < `columns` is not checked. `names`
/// and `file` are for the message. Throws Error(kBadInput) with file and line if the field is
/// empty.
template <std::size_t columns>
double required_field(const CsvRow<columns>& row, const std::array<std::string, columns>& names,
                      std::size_t i, const std::string& file) {
  if (!row.fields[i])
    throw_bad_input({file, row.line}, names[i] + " is empty; it must be a number");
  return *row.fields[i];
}

}  // namespace viscontact
