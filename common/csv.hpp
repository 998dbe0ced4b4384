// CSV files as Viscontact writes them: "# key: value" lines, then a header line, then rows of
// numbers.
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

namespace viscontact {

/// The "# key: value" lines at the head of a file, in order of key.
using CsvComments = std::map<std::string, std::string>;

/// One row: the fields of the asked columns as numbers (empty: nothing), and its line in the file.
template <std::size_t columns>
struct CsvRow {
  std::array<std::optional<double>, columns> fields;
  int line = 0;
};

template <std::size_t columns>
struct CsvFile {
  CsvComments comments;
  std::set<std::string> contradictions;  ///< keys that stand twice, with different values
  std::vector<CsvRow<columns>> rows;
};

/// The "# key: value" lines of `text`, without commas at their end, which spreadsheets add. Of a key that stands twice the last; it is put into
/// `contradictions` if the values differ.
CsvComments read_csv_comments(const std::string& text,
                              std::set<std::string>* contradictions = nullptr);

/// "# key: value" lines for `comments`.
std::string write_csv_comments(const CsvComments& comments);

/// A comment that must be there as a finite number. Throws Error(kBadInput) naming file and key.
double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file);

/// For a message about missing columns: the header line; or ", whose fields seem to be separated by ..." if the header line has no comma but that.
std::string hint_of_separator(const std::string& text);

/// Removes the lines at the end of `text` that hold nothing but spaces, tabs and commas, as editors
/// and spreadsheets leave them: they are no rows. Blank lines above the last row stay.
void remove_trailing_blank_lines(std::string& text);

/// Text fit to be shown in a message: its beginning, if it is long.
std::string shortened(const std::string& text);

/// Most columns that can be asked of a file.
constexpr std::size_t kMostCsvColumns = 16;

/// What read_csv does, for any number of columns: calls `add_row` with the fields of each row and its
/// line in the file. The library is instantiated in csv.cpp alone, because each number of columns
/// costs seconds to compile.
void read_csv_rows(
    const std::filesystem::path& path, std::span<const std::string> names, std::size_t required,
    CsvComments& comments, std::set<std::string>& contradictions,
    const std::function<void(std::span<const std::optional<double>> fields, int line)>& add_row);

/// The asked columns of a CSV file, in the order of `names`; the file may have them in another
/// order, and others besides. The first `required` columns must be there, the others read as empty
/// where they are not. Blank lines after the last row are no rows. Throws Error(kBadInput) with file and line for a missing column, a row of
/// another length, a field that is neither empty nor a finite number, or fewer rows than a line "#
/// rows: N" promises (a truncated file).
template <std::size_t columns>
CsvFile<columns> read_csv(const std::filesystem::path& path,
                          const std::array<std::string, columns>& names, std::size_t required) {
  static_assert(columns <= kMostCsvColumns);
  CsvFile<columns> result;
  read_csv_rows(path, names, required, result.comments, result.contradictions,
                [&](std::span<const std::optional<double>> fields, int line) {
                  auto& row = result.rows.emplace_back();
                  std::copy_n(fields.begin(), columns, row.fields.begin());
                  row.line = line;
                });
  return result;
}

/// The number in column `i` of a row. Throws Error(kBadInput) with file and line if the field is
/// empty.
template <std::size_t columns>
double required_field(const CsvRow<columns>& row, const std::array<std::string, columns>& names,
                      std::size_t i, const std::string& file) {
  if (!row.fields[i])
    throw_bad_input({file, row.line}, names[i] + " is empty; it must be a number");
  return *row.fields[i];
}

}  // namespace viscontact
