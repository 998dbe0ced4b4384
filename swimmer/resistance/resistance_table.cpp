// Reads and writes the CSV file of a resistance table (docs/file-formats.md). Lengths, masses and
// times are in any one consistent system of units.
#include "viscontact/swimmer/resistance/resistance_table.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <optional>
#include <sstream>

#include "viscontact/common/files/file.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/swimmer/resistance/resistance_matrix.hpp"

namespace viscontact::swimmer {
namespace {

constexpr std::string_view kVersionOf = "version of ";
const std::string kRadii = "radii";

/// "12", or "9_10" if a number has two digits. i and j count from 0.
std::string pair_name(std::size_t i, std::size_t j) {
  return fmt::format("{}{}{}", i + 1, std::max(i, j) >= 9 ? "_" : "", j + 1);
}

std::vector<double> read_radii(const CsvComments& comments, const std::string& file) {
  const auto found = comments.find(kRadii);
  if (found == comments.end())
    throw_bad_input({file}, "the line '# radii: NUMBER NUMBER ...' is missing");
  std::vector<double> radii;
  std::istringstream words(found->second);
  for (std::string word; words >> word;) {
    const auto radius = parse_number(word);
    if (!radius || !(*radius > 0))
      throw_bad_input({file},
                      fmt::format("# radii: contains '{}'; each must be a number > 0", word));
    radii.push_back(*radius);
  }
  if (radii.size() < kFewestSpheres || radii.size() > kMostSpheres)
    throw_bad_input({file}, fmt::format("# radii: has {} numbers; it must have {} to {}",
                                        radii.size(), kFewestSpheres, kMostSpheres));
  return radii;
}

/// The fields of one row of the file.
struct Fields {
  std::vector<std::optional<double>> values;
  int line = 0;
};

/// Reads any number of columns, at most kMostCsvColumns at a time, because read_csv_rows() takes no
/// more.
std::vector<Fields> read_fields(const std::filesystem::path& path,
                                const std::vector<std::string>& columns, std::size_t required,
                                CsvComments& comments) {
  std::vector<Fields> rows;
  for (std::size_t first = 0; first < columns.size(); first += kMostCsvColumns) {
    const std::size_t count = std::min(kMostCsvColumns, columns.size() - first);
    const std::size_t needed = std::min(count, required > first ? required - first : 0);
    std::size_t row = 0;
    std::set<std::string> contradictions;
    read_csv_rows(path, std::span(columns).subspan(first, count), needed, comments, contradictions,
                  [&](std::span<const std::optional<double>> fields, int line) {
                    if (first == 0) rows.push_back({{}, line});
                    auto& values = rows.at(row++).values;
                    values.insert(values.end(), fields.begin(),
                                  fields.begin() + static_cast<std::ptrdiff_t>(count));
                  });
  }
  return rows;
}

/// Checks the numbers of one row and copies them into the members of a ResistanceRow.
ResistanceRow read_row(const Fields& fields, const std::vector<std::string>& columns,
                       std::size_t spheres, const std::string& file) {
  const FilePosition here{file, fields.line};
  const std::size_t gaps = spheres - 1, entries = entry_count(spheres);
  ResistanceRow row;
  for (std::size_t i = 0; i < gaps + entries; ++i) {
    if (!fields.values[i]) throw_bad_input(here, columns[i] + " is empty; it must be a number");
    (i < gaps ? row.gaps : row.entries).push_back(*fields.values[i]);
  }
  for (std::size_t i = 0; i < gaps; ++i)
    if (!(row.gaps[i] > 0))
      throw_bad_input(here, fmt::format("{} is {}; it must be > 0", columns[i], row.gaps[i]));
  if (Eigen::LLT<Eigen::MatrixXd> factor(matrix_of(row, spheres)); factor.info() != Eigen::Success)
    throw_bad_input(here, "the matrix R is not positive definite; forces would drive the spheres");
  std::size_t next = gaps + entries;
  for (std::size_t i = 0; i < entries; ++i, ++next) {
    row.relative_error_estimates.push_back(fields.values[next].value_or(0));
    if (row.relative_error_estimates.back() < 0)
      throw_bad_input(here, fmt::format("{} is {}; it must be >= 0", columns[next],
                                        row.relative_error_estimates.back()));
  }
  ++next;  // skips relative_error_estimate, which is the largest of the estimates before
  row.degrees_of_freedom = fields.values[next++].value_or(0);
  row.seconds = fields.values[next++].value_or(0);
  row.observed_order = fields.values[next].value_or(0);
  return row;
}

}  // namespace

double ResistanceRow::largest_error_estimate() const {
  return relative_error_estimates.empty() ? 0 : std::ranges::max(relative_error_estimates);
}

std::size_t entry_position(std::size_t i, std::size_t j, std::size_t spheres) {
  const auto [row, column] = std::minmax(i, j);
  return row * spheres - row * (row + 1) / 2 + column;
}

std::vector<std::string> resistance_columns(std::size_t spheres) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i + 1 < spheres; ++i) columns.push_back("gap" + pair_name(i, i + 1));
  std::vector<std::string> estimates;
  for (std::size_t i = 0; i < spheres; ++i)
    for (std::size_t j = i; j < spheres; ++j) {
      columns.push_back("R" + pair_name(i, j));
      estimates.push_back(columns.back() + "_relative_error_estimate");
    }
  columns.insert(columns.end(), estimates.begin(), estimates.end());
  for (const char* name :
       {"relative_error_estimate", "degrees_of_freedom", "seconds", "observed_order"})
    columns.emplace_back(name);
  return columns;
}

ResistanceTable read_resistance_table(const std::filesystem::path& path) {
  const std::string file = path.string();
  auto comments = read_csv_comments(read_file(path));
  ResistanceTable table;
  table.radii = read_radii(comments, file);
  table.viscosity = csv_comment_number(comments, "viscosity", file);
  if (!(table.viscosity > 0))
    throw_bad_input({file}, fmt::format("# viscosity: is {}; it must be > 0", table.viscosity));
  const std::size_t spheres = table.radii.size();
  const auto columns = resistance_columns(spheres);
  for (const auto& fields :
       read_fields(path, columns, spheres - 1 + entry_count(spheres), comments))
    table.rows.push_back(read_row(fields, columns, spheres, file));
  if (table.rows.empty())
    throw_bad_input({file}, "has no rows below its header line; it needs at least one");
  const auto comment_or_empty = [&](const std::string& key) {
    const auto found = comments.find(key);
    return found == comments.end() ? std::string() : found->second;
  };
  table.container = comment_or_empty("container");
  table.case_hash = comment_or_empty("case");
  for (const auto& [key, value] : comments)
    if (key.starts_with(kVersionOf)) table.versions[key.substr(kVersionOf.size())] = value;
  return table;
}

std::string write_resistance_table(const ResistanceTable& table) {
  std::string radii;
  for (const double radius : table.radii)
    radii += (radii.empty() ? "" : " ") + format_number(radius);
  CsvComments comments = {{"viscontact", "resistance table"},
                          {"viscosity", format_number(table.viscosity)},
                          {kRadii, radii},
                          {"container", table.container},
                          {"rows", std::to_string(table.rows.size())}};
  if (!table.case_hash.empty()) comments["case"] = table.case_hash;
  for (const auto& [program, version] : table.versions)
    comments[std::string(kVersionOf) + program] = version;
  std::string text = write_csv_comments(comments);
  text += fmt::format("{}\n", fmt::join(resistance_columns(table.radii.size()), ","));
  for (const auto& row : table.rows) {
    for (const auto* numbers : {&row.gaps, &row.entries, &row.relative_error_estimates})
      for (const double number : *numbers) text += format_number(number) + ",";
    text += fmt::format("{},{},{},{}\n", format_number(row.largest_error_estimate()),
                        format_number(row.degrees_of_freedom), format_number(row.seconds),
                        format_number(row.observed_order));
  }
  return text;
}

}  // namespace viscontact::swimmer
