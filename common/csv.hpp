// CSV files as Viscontact writes them: "# key: value" lines, then a header line, then rows of
// numbers.
#pragma once

// The library copies names by strncpy on purpose and terminates them in the next line; GCC 12 warns
// all the same.
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

/// The asked columns of a CSV file, in the order of `names`; the file may have them in another
/// order, and others besides. The first `required` columns must be there, the others read as empty
/// where they are not. Blank lines after the last row are no rows. Throws Error(kBadInput) with file and line for a missing column, a row of
/// another length, a field that is neither empty nor a finite number, or fewer rows than a line "#
/// rows: N" promises (a truncated file).
template <std::size_t columns>
CsvFile<columns> read_csv(const std::filesystem::path& path,
                          const std::array<std::string, columns>& names, std::size_t required) {
  const std::string file = path.string();
  std::string text = read_file(path);
  remove_trailing_blank_lines(text);
  CsvFile<columns> result;
  result.comments = read_csv_comments(text, &result.contradictions);
  std::istringstream stream(text);
  // Fields are taken as text: the library's own conversion to double does not round-trip.
  using Reader = io::CSVReader<columns, io::trim_chars<' ', '\t'>, io::no_quote_escape<','>,
                               io::throw_on_overflow, io::single_line_comment<'#'>>;
  try {
    Reader reader("", stream);  // it would cut a long name; errors get ours below
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
  // A cut within the last field can leave a number: a file that says its rows ends its last line too.
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
