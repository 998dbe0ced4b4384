// Computes means over the draws of each point (means.hpp). The draws of a point follow each other
// in the file, so that only one point is in memory at a time.
#include "viscontact/sweep/particles/means.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::sweep {
namespace {

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line)
    if (c == ',')
      fields.emplace_back();
    else
      fields.back() += c;
  return fields;
}

/// "MEAN,STANDARD_ERROR" of some values; fields that the values do not give are empty.
std::string mean_fields(const std::vector<double>& values) {
  if (values.empty()) return ",";
  const auto n = static_cast<double>(values.size());
  // This form of the mean has no rounding error if all values are equal (Welford 1962).
  double mean = 0, squares = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    mean += (values[i] - mean) / static_cast<double>(i + 1);
  for (const double value : values) squares += (value - mean) * (value - mean);
  if (!std::isfinite(mean) || !std::isfinite(squares)) return ",";
  return format_number(mean) + "," +
         (values.size() < 2 ? "" : format_number(std::sqrt(squares / (n - 1) / n)));
}

/// The results of the draws of one point.
struct Draws {
  std::string keys;  ///< the varied keys, each followed by a comma
  std::uint64_t succeeded = 0, failed = 0;
  std::vector<std::vector<double>> values;  ///< of each column
};

std::string row_of(const Draws& draws) {
  std::string text = fmt::format("{}{},{}", draws.keys, draws.succeeded, draws.failed);
  for (const auto& values : draws.values) text += "," + mean_fields(values);
  return text + "\n";
}

}  // namespace

std::string table_of_means(const ParticlesSweep& sweep, const std::filesystem::path& path) {
  const auto& columns = sweep.result_columns();
  const std::size_t keys = sweep.keys().size(), varied = sweep.plan().variations.size();
  std::string text = write_csv_comments(
      {{"viscontact", "means of a sweep of particles"}, {"rows", std::to_string(sweep.points())}});
  for (const auto& variation : sweep.plan().variations) text += variation.key + ",";
  text += "draws,failed";
  for (const auto& column : columns) text += fmt::format(",{0}.mean,{0}.standard_error", column);
  text += "\n";

  std::ifstream file(path, std::ios::binary);
  const std::uint64_t draws_of_a_point = sweep.size() / sweep.points();
  std::uint64_t row = 0;
  bool header_is_read = false;
  Draws draws;
  for (std::string line; row < sweep.size() && std::getline(file, line);) {
    if (line.starts_with('#')) continue;
    if (!header_is_read) {
      header_is_read = true;
      continue;
    }
    const auto fields = fields_of(line);
    if (fields.size() != keys + columns.size() + 1 ||
        !line.starts_with(sweep.key_fields(row) + ","))
      throw_bad_input({path.string()}, fmt::format("row {} is not that of the sweep", row + 1));
    if (row % draws_of_a_point == 0) {
      draws = {};
      for (std::size_t i = 0; i < varied; ++i) draws.keys += fields[i] + ",";
      draws.values.resize(columns.size());
    }
    const bool has_failed = !fields.back().empty();
    ++(has_failed ? draws.failed : draws.succeeded);
    for (std::size_t i = 0; i < columns.size() && !has_failed; ++i)
      if (const auto value = parse_number(fields[keys + i])) draws.values[i].push_back(*value);
    if (++row % draws_of_a_point == 0) text += row_of(draws);
  }
  if (row < sweep.size())
    throw_bad_input({path.string()},
                    fmt::format("has {} rows; the sweep has {}", row, sweep.size()));
  return text;
}

std::filesystem::path path_of_means(const std::filesystem::path& rows) {
  auto name = rows.stem();
  name += "_means";
  name += rows.extension();
  return rows.parent_path() / name;
}

}  // namespace viscontact::sweep
