// CSV files as Viscontact writes them: lines "# key: value", a header line, and rows of numbers.
#pragma once

// The library copies names by strncpy on purpose and terminates them in the next line, but GCC 12
// warns.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstringop-truncation"
#include <libfccp/csv.h>
#pragma GCC diagnostic pop

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/files/file.hpp"
#include "viscontact/common/number.hpp"

namespace viscontact {

/// The lines "# key: value" at the head of a file, sorted by key.
using CsvComments = std::map<std::string, std::string>;

/// A row: the fields of the requested columns as numbers (nothing for an empty field), and the
/// number of its line in the file.
template <std::size_t columns>
struct CsvRow {
  std::array<std::optional<double>, columns> fields;
  int line = 0;
};

template <std::size_t columns>
struct CsvFile {
  CsvComments comments;
  std::set<std::string> contradictions;  ///< keys that occur twice with different values
  std::vector<CsvRow<columns>> rows;
};

/// Reads the lines "# key: value" of `text`, without the commas at their end that spreadsheets add.
/// If a key occurs twice, the last value counts; if the values differ, the key is added to
/// `contradictions`.
CsvComments read_csv_comments(const std::string& text,
                              std::set<std::string>* contradictions = nullptr);

/// The lines "# key: value" for `comments`.
std::string write_csv_comments(const CsvComments& comments);

/// The value of a comment that must be a finite number. Throws Error(kBadInput), which names the
/// file and the key, if it is missing or is no number.
double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file);

/// Text to be added to a message about missing columns: ", 'the header line'", or the probable
/// reason why its columns were not found (quotes, another separator, UTF-16).
std::string hint_of_separator(const std::string& text);

/// Removes the lines at the end of `text` that contain only spaces, tabs and commas, which editors
/// and spreadsheets leave. Blank lines above the last row stay.
void remove_trailing_blank_lines(std::string& text);

/// A text for a message: its first 60 characters and "..." if it is longer.
std::string shortened(const std::string& text);

/// Reads the columns `names` of a CSV file, in this order. The file may have its columns in another
/// order, and further columns. The first `required` columns must exist; the fields of others are
/// empty if their column is missing. Blank lines after the last row are ignored.
///
/// Throws Error(kBadInput) with file and line for a missing column, a row with more or fewer fields
/// than the header line, a field that is neither empty nor a finite number, and a number of rows
/// that differs from a line "# rows: N" (which shows that the file was cut short).
template <std::size_t columns>
CsvFile<columns> read_csv(const std::filesystem::path& path,
                          const std::array<std::string, columns>& names, std::size_t required) {
  const std::string file = path.string();
  std::string text = read_file(path);
  remove_trailing_blank_lines(text);
  CsvFile<columns> result;
  result.comments = read_csv_comments(text, &result.contradictions);
  std::istringstream stream(text);
  // Fields are read as text, because the library's own conversion to double does not give back the
  // same number.
  using Reader = io::CSVReader<columns, io::trim_chars<' ', '\t'>, io::no_quote_escape<','>,
                               io::throw_on_overflow, io::single_line_comment<'#'>>;
  try {
    // The file has no name here, because the library cuts long names; the messages below name it.
    Reader reader("", stream);
    std::apply(
        [&](const auto&... name) {
          reader.read_header(io::ignore_extra_column | io::ignore_missing_column, name...);
        },
        names);
    for (std::size_t i = 0; i < required; ++i)
      if (!reader.has_column(names[i]))
        throw_bad_input({file}, "column '" + names[i] + "' is missing from the header line" +
                                    hint_of_separator(text));
    std::array<char*, columns> fields{};
    while (std::apply([&](auto&... field) { return reader.read_row(field...); }, fields)) {
      CsvRow<columns> row;
      row.line = static_cast<int>(reader.get_file_line());
      for (std::size_t i = 0; i < columns; ++i) {
        if (fields[i] == nullptr || *fields[i] == '\0') continue;
        row.fields[i] = parse_number(fields[i]);
        if (!row.fields[i])
          throw_bad_input({file, row.line},
                          names[i] + " is not a finite number ('" + shortened(fields[i]) + "')");
      }
      result.rows.push_back(row);
    }
  } catch (const io::error::duplicated_column_in_header& e) {
    throw_bad_input({file},
                    std::string("column '") + e.column_name + "' stands twice in the header line");
  } catch (const io::error::header_missing&) {
    throw_bad_input({file},
                    "has no header line; it must name the columns, such as '" + names[0] + "'");
  } catch (const io::error::too_few_columns& e) {
    throw_bad_input({file, e.file_line}, "has fewer fields than the header line");
  } catch (const io::error::too_many_columns& e) {
    throw_bad_input({file, e.file_line}, "has more fields than the header line");
  } catch (const io::error::line_length_limit_exceeded& e) {
    throw_bad_input({file, e.file_line}, "this line is too long for a CSV file");
  } catch (const io::error::base& e) {
    throw_bad_input({file}, e.what());
  }
  // A file that was cut within its last field may still end with a number. A file that states its
  // number of rows must therefore also end its last line.
  if (const auto promised = result.comments.find("rows");
      promised != result.comments.end() &&
      (promised->second != std::to_string(result.rows.size()) || text.back() != '\n'))
    throw_bad_input({file}, "has " + std::to_string(result.rows.size()) +
                                " rows where its header says " + promised->second +
                                ", or its last line has no end; is it truncated?");
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
