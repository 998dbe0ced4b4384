// Tables as text files (docs/file-formats.md), for any struct Row that holds the numbers of a row.
#pragma once

#include <span>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

// A Row has these declarations in its namespace:
//   static constexpr bool Row::kIsOfLine: true if the head has the radii of several spheres;
//   void prepare(const TableHead&, Row&): gives the vectors and optional members of a row the sizes
//     that columns_of() needs;
//   std::vector<Column> columns_of(const TableHead&, Row&): the columns in the order of the file,
//     with those that identify a row, such as the gap, first;
//   void complete(const TableHead&, Row&): computes numbers that follow from others;
//   void check(const TableHead&, const Row&, const FilePosition&): throws Error(kBadInput) if the
//     numbers contradict each other.

/// Reads the lines "# key: value" in the text of a file, which messages call `file`; `is_of_line`
/// is Row::kIsOfLine. Throws Error(kBadInput) with file and key if viscosity or radius (radii, if
/// `is_of_line`) is missing, if a number or motion is wrong, or if motion, viscosity, radius, radii
/// or a leading coefficient stands twice with different values.
TableHead read_head(const std::string& text, const std::string& file, bool is_of_line);

/// The lines of the head of a table with `rows` rows.
CsvComments lines_of(const TableHead& head, std::size_t rows);

/// Sets the numbers of a row from the fields of its line, one for each column. A field without a
/// value gives 0 or NaN (IfAbsent). Throws Error(kBadInput) for a number that is missing although
/// it is required, or not allowed in its column.
void set_numbers(const std::vector<Column>& columns, std::span<const std::optional<double>> fields,
                 const FilePosition& here);

/// Reads a table. Throws Error(kBadInput) with file and line if a value is missing, not finite or
/// out of range, if the line "# rows" of the head says another number of rows (the file is
/// truncated), if there are no rows, or if the file cannot be read. Throws the errors of
/// read_head() and check(), too.
template <class Row>
Table<Row> read_table(const std::filesystem::path& path) {
  const std::string file = path.string(), text = read_file(path);
  Table<Row> table{read_head(text, file, Row::kIsOfLine), {}};
  Row blank;
  prepare(table, blank);
  std::vector<std::string> names;
  std::size_t required = 0;
  for (const auto& column : columns_of(table, blank)) {
    names.push_back(column.name);
    if (column.if_absent == IfAbsent::kRefused) ++required;
  }
  read_csv_rows(text, file, names, required,
                [&](std::span<const std::optional<double>> fields, int line) {
                  auto& row = table.rows.emplace_back(blank);
                  set_numbers(columns_of(table, row), fields, {file, line});
                  complete(table, row);
                  check(table, row, {file, line});
                });
  if (table.rows.empty())
    throw_bad_input({file}, "has no rows below its header line; it needs at least one");
  return table;
}

/// The text of the file. Every number has as many digits as are needed to read the same double
/// back. Without rows the line of column names is missing.
template <class Row>
std::string write_table(const Table<Row>& table) {
  std::string text = write_csv_comments(lines_of(table, table.rows.size())), numbers;
  for (auto row : table.rows) {
    complete(table, row);
    const auto columns = columns_of(table, row);
    if (numbers.empty())
      for (const auto& column : columns)
        text += column.name + (&column == &columns.back() ? "\n" : ",");
    for (const auto& column : columns) numbers += format_number(*column.number) + ",";
    numbers.back() = '\n';
  }
  return text + numbers;
}

}  // namespace viscontact::lubrication
