#include "reduced_model/trajectory.hpp"

#include <fmt/format.h>

#include <iterator>

#include "common/csv.hpp"

namespace viscontact {
namespace {

const std::array<std::string, 6> kColumns = {
    "time", "gap", "velocity", "lubrication_force", "external_force", "gamma"};
constexpr std::size_t kRequiredColumns = 3;

std::string optional_number(const std::optional<double>& value) {
  return value ? format_number(*value) : "";
}

}  // namespace

Trajectory read_trajectory(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto csv = read_csv(path, kColumns, kRequiredColumns);
  Trajectory trajectory;
  trajectory.model = path.stem().string();
  trajectory.provenance = csv.comments;
  const auto take = [&](const std::string& key) -> std::optional<std::string> {
    const auto found = trajectory.provenance.extract(key);
    return found.empty() ? std::nullopt : std::optional(found.mapped());
  };
  if (const auto model = take("model")) trajectory.model = *model;
  if (csv.comments.contains("recovered_minimal_gap"))
    trajectory.recovered_minimal_gap =
        csv_comment_number(csv.comments, "recovered_minimal_gap", file);
  if (csv.comments.contains("steps"))
    trajectory.steps = static_cast<long>(csv_comment_number(csv.comments, "steps", file));
  if (csv.comments.contains("seconds"))
    trajectory.seconds = csv_comment_number(csv.comments, "seconds", file);
  for (const char* key : {"viscontact", "recovered_minimal_gap", "steps", "seconds", "rows"})
    take(key);
  trajectory.rows.reserve(csv.rows.size());
  for (const auto& fields : csv.rows) {
    TrajectoryRow row;
    row.time = required_field(fields, kColumns, 0, file);
    row.gap = required_field(fields, kColumns, 1, file);
    row.velocity = required_field(fields, kColumns, 2, file);
    row.lubrication_force = fields.fields[3];
    row.external_force = fields.fields[4];
    row.gamma = fields.fields[5];
    const FilePosition here{file, fields.line};
    if (row.gap < 0) throw_bad_input(here, fmt::format("gap is {}; must be >= 0", row.gap));
    if (!trajectory.rows.empty() && !(row.time > trajectory.rows.back().time))
      throw_bad_input(here, fmt::format("time is {} after {}; must increase", row.time,
                                        trajectory.rows.back().time));
    trajectory.rows.push_back(row);
  }
  if (trajectory.rows.empty()) throw_bad_input({file}, "has no rows");
  return trajectory;
}

std::string write_trajectory(const Trajectory& trajectory) {
  CsvComments comments = trajectory.provenance;
  comments["viscontact"] = "trajectory";
  comments["model"] = trajectory.model;
  comments["rows"] = std::to_string(trajectory.rows.size());
  comments["steps"] = std::to_string(trajectory.steps);
  comments["seconds"] = format_number(trajectory.seconds);
  if (trajectory.recovered_minimal_gap)
    comments["recovered_minimal_gap"] = format_number(*trajectory.recovered_minimal_gap);
  std::string text = write_csv_comments(comments);
  text += fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const auto& row : trajectory.rows)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", format_number(row.time),
                   format_number(row.gap), format_number(row.velocity),
                   optional_number(row.lubrication_force), optional_number(row.external_force),
                   optional_number(row.gamma));
  return text;
}

}  // namespace viscontact
