// Reads CSV files by fast-cpp-csv-parser.
#include "viscontact/common/text/csv.hpp"

#include <fmt/format.h>

// GCC 12 warns, because the library copies names by strncpy and terminates them afterwards.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstringop-truncation"
#include <libfccp/csv.h>
#pragma GCC diagnostic pop

#include <algorithm>
#include <cassert>
#include <sstream>
#include <tuple>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/common/text/utf16.hpp"

namespace viscontact {
namespace {

constexpr std::string_view kByteOrderMark =
    "\xEF\xBB\xBF";  // some spreadsheets write it at the head

/// The end of a message about missing columns: the header line in quotes, or the probable reason
/// why its columns were not found. Empty if neither can be said.
std::string hint_of_separator(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) continue;
    if (line.find('"') != std::string::npos)
      return ", '" + shortened(line) + "'; the names of columns must stand without quotes";
    if (line.find(',') != std::string::npos) return ", '" + shortened(line) + "'";
    if (line.find(';') != std::string::npos)
      return ", whose fields are separated by semicolons; they must be separated by commas, with "
             "decimal points";
    if (line.find('\t') != std::string::npos)
      return ", whose fields are separated by tabs; they must be separated by commas";
    return "";
  }
  return "";
}

/// Removes lines of spaces, tabs and commas at the end, which editors and spreadsheets leave.
void remove_trailing_blank_lines(std::string& text) {
  const auto last = text.find_last_not_of(" \t\r\n,");
  if (last == std::string::npos) return;
  // Empty fields at the end of the last row belong to it.
  const auto end_of_row = text.find('\n', last);
  if (end_of_row != std::string::npos) text.erase(end_of_row + 1);
}

/// Nothing if the field is empty or missing. Throws Error(kBadInput) if it is no finite number.
std::optional<double> number_of(const char* field, const std::string& column,
                                const std::string& file, int line) {
  if (field == nullptr || *field == '\0') return {};
  const auto number = parse_number(field);
  if (!number)
    throw_bad_input({file, line, column},
                    column + " is not a finite number ('" + shortened(field) + "')");
  return number;
}

/// Throws Error(kBadInput) if the header states another number of rows, or the text does not end
/// with a line break. The second test is needed because a file that is cut off within its last
/// field can still end with a number.
void check_not_truncated(const CsvComments& comments, std::size_t rows, const std::string& text,
                         const std::string& file) {
  const auto stated = comments.find("rows");
  if (stated == comments.end() || (stated->second == std::to_string(rows) && text.back() == '\n'))
    return;
  throw_bad_input({file},
                  fmt::format("has {} rows where its header says {}, or its last line does not "
                              "end with a line break; the file may be cut off",
                              rows, stated->second));
}

using Fields = std::span<const std::optional<double>>;

// Columns that the library reads at once. The number is a template argument of the library, and the
// same for all files, because each other value takes seconds to compile.
constexpr std::size_t kColumnsAtOnce = 16;

/// Calls `add_row` with the fields of each row and its line, for at most kColumnsAtOnce `names`.
/// Throws the errors of read_csv(), except that for a wrong number of rows.
void read_columns(const std::string& text, const std::string& file,
                  std::span<const std::string> names, std::size_t required,
                  const std::function<void(Fields fields, int line)>& add_row) {
  assert(names.size() <= kColumnsAtOnce);
  refuse_utf16(text, file);
  // The library needs kColumnsAtOnce names. No header line can contain the surplus ones.
  std::array<std::string, kColumnsAtOnce> all_names;
  all_names.fill("\n");
  std::ranges::copy(names, all_names.begin());
  std::istringstream stream(text);
  // Fields are taken as text, because the library's own conversion to double loses the last digits.
  using Reader = io::CSVReader<kColumnsAtOnce, io::trim_chars<' ', '\t'>, io::no_quote_escape<','>,
                               io::throw_on_overflow, io::single_line_comment<'#'>>;
  try {
    // The reader gets no file name, because it would cut off a long one; the errors below name it.
    Reader reader("", stream);
    std::apply(
        [&](const auto&... name) {
          reader.read_header(io::ignore_extra_column | io::ignore_missing_column, name...);
        },
        all_names);
    for (std::size_t i = 0; i < std::min(required, names.size()); ++i)
      if (!reader.has_column(names[i]))
        throw_bad_input(
            {file, 0, names[i]},
            "column '" + names[i] + "' is missing from the header line" + hint_of_separator(text));
    std::array<char*, kColumnsAtOnce> fields{};
    std::array<std::optional<double>, kColumnsAtOnce> numbers;
    while (std::apply([&](auto&... field) { return reader.read_row(field...); }, fields)) {
      const int line = static_cast<int>(reader.get_file_line());
      for (std::size_t i = 0; i < names.size(); ++i)
        numbers[i] = number_of(fields[i], names[i], file, line);
      add_row(std::span(numbers).first(names.size()), line);
    }
  } catch (const io::error::duplicated_column_in_header& e) {
    throw_bad_input({file, 0, e.column_name},
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
}

}  // namespace

CsvComments read_csv_comments(const std::string& text, std::set<std::string>* contradictions) {
  CsvComments comments;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with(kByteOrderMark)) line.erase(0, kByteOrderMark.size());
    if (line.empty() || line[0] != '#') continue;
    // This loop ends at the '#' at the beginning of the line, at the latest.
    while (line.back() == '\r' || line.back() == ',') line.pop_back();
    const auto colon = line.find(": ");
    const auto start = line.find_first_not_of("# \t");
    if (colon == std::string::npos || start >= colon) continue;
    const auto [place, is_new] =
        comments.insert({line.substr(start, colon - start), line.substr(colon + 2)});
    if (is_new || place->second == line.substr(colon + 2)) continue;
    place->second = line.substr(colon + 2);
    if (contradictions != nullptr) contradictions->insert(place->first);
  }
  return comments;
}

std::string write_csv_comments(const CsvComments& comments) {
  std::string text;
  for (const auto& [key, value] : comments) text += fmt::format("# {}: {}\n", key, value);
  return text;
}

std::vector<std::string> csv_fields(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

CsvHeader csv_header(const std::string& text) {
  std::istringstream lines(text.starts_with(kByteOrderMark) ? text.substr(kByteOrderMark.size())
                                                            : text);
  CsvHeader header;
  std::string line;
  do ++header.line;
  while (std::getline(lines, line) && (line.empty() || line[0] == '#'));
  if (!lines) return header;
  std::istringstream fields(line);
  for (std::string name; std::getline(fields, name, ',');) {
    const auto first = name.find_first_not_of(" \t\r"), last = name.find_last_not_of(" \t\r");
    header.names.push_back(first == std::string::npos ? "" : name.substr(first, last - first + 1));
  }
  return header;
}

std::string shortened(const std::string& text) {
  constexpr std::size_t kLongest = 60;
  auto shown = text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
  // A terminal would take control characters for commands.
  std::ranges::replace_if(
      shown, [](unsigned char c) { return c < ' ' || c == 127; }, '?');
  return shown;
}

double csv_comment_number(const CsvComments& comments, const std::string& key,
                          const std::string& file) {
  const auto found = comments.find(key);
  if (found == comments.end())
    throw_bad_input({file, 0, key}, fmt::format("the line '# {}: NUMBER' is missing", key));
  const auto value = parse_number(found->second);
  if (!value)
    throw_bad_input({file, 0, key}, fmt::format("the line '# {}: {}' must give a finite number",
                                                key, found->second));
  return *value;
}

void read_csv_rows(
    std::string text, const std::string& file, std::span<const std::string> names,
    std::size_t required,
    const std::function<void(std::span<const std::optional<double>> fields, int line)>& add_row) {
  assert(!names.empty());
  remove_trailing_blank_lines(text);
  std::size_t count = 0;
  if (names.size() <= kColumnsAtOnce) {
    read_columns(text, file, names, required, [&](Fields fields, int line) {
      add_row(fields, line);
      ++count;
    });
  } else {
    std::vector<std::pair<int, std::vector<std::optional<double>>>> rows;
    for (std::size_t first = 0; first < names.size(); first += kColumnsAtOnce) {
      std::size_t row = 0;
      read_columns(text, file, names.subspan(first, std::min(kColumnsAtOnce, names.size() - first)),
                   required - std::min(required, first), [&](Fields fields, int line) {
                     if (first == 0) rows.push_back({line, {}});
                     auto& all = rows[row++].second;
                     all.insert(all.end(), fields.begin(), fields.end());
                   });
    }
    for (const auto& [line, fields] : rows) add_row(fields, line);
    count = rows.size();
  }
  check_not_truncated(read_csv_comments(text), count, text, file);
}

}  // namespace viscontact
