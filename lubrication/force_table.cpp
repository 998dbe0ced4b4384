// Reads and writes the CSV file of a force table (docs/file-formats.md). Lengths, masses and times
// are in any one consistent system of units.
#include "viscontact/lubrication/force_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::lubrication {
namespace {

const std::array<std::string, 8> kColumns = {
    "gap",         "reference_velocity",      "force",
    "drag_factor", "relative_error_estimate", "degrees_of_freedom",
    "seconds",     "observed_order"};
// The first three of kColumns: a fit needs no more than gap, velocity and force.
constexpr std::size_t kRequiredColumns = 3;
constexpr std::string_view kVersionPrefix = "version of ";
const std::string kNeighbourMoves = "neighbour_moves";
const std::string kLeadingCoefficient = "leading_coefficient";
const std::string kTabulatedMotions = "motions";

std::string comment_or(const CsvComments& comments, const std::string& key) {
  const auto found = comments.find(key);
  return found == comments.end() ? "" : found->second;
}

double positive_comment(const CsvComments& comments, const std::string& key,
                        const std::string& file) {
  const double value = csv_comment_number(comments, key, file);
  if (!(value > 0)) throw_bad_input({file}, fmt::format("# {}: is {}; it must be > 0", key, value));
  return value;
}

}  // namespace

ForceTable read_force_table(const std::filesystem::path& path) {
  const std::string file = path.string();
  const auto csv = read_csv(path, kColumns, kRequiredColumns);
  ForceTable table;
  for (const auto& key : {std::string("viscosity"), std::string("radius"), kLeadingCoefficient})
    if (csv.contradictions.contains(key))
      throw_bad_input(
          {file}, fmt::format("# {}: stands twice with different values; it must stand once", key));
  table.viscosity = positive_comment(csv.comments, "viscosity", file);
  table.radius = positive_comment(csv.comments, "radius", file);
  table.geometry = comment_or(csv.comments, "geometry");
  table.neighbour_moves = comment_or(csv.comments, kNeighbourMoves) == "yes";
  if (csv.comments.contains(kLeadingCoefficient))
    table.leading_coefficient = positive_comment(csv.comments, kLeadingCoefficient, file);
  table.container = comment_or(csv.comments, "container");
  table.case_hash = comment_or(csv.comments, "case");
  table.tabulated_motions = with_place(file + ": # " + kTabulatedMotions, [&] {
    return parse_motions_in_words(comment_or(csv.comments, kTabulatedMotions));
  });
  table.failed_rows = failed_rows_in(csv.comments);
  for (const auto& [key, value] : csv.comments)
    if (key.starts_with(kVersionPrefix)) table.versions[key.substr(kVersionPrefix.size())] = value;
  for (const auto& fields : csv.rows) {
    const FilePosition here{file, fields.line};
    ForceTableRow row;
    row.gap = required_field(fields, kColumns, 0, file);
    row.reference_velocity = required_field(fields, kColumns, 1, file);
    row.force = required_field(fields, kColumns, 2, file);
    if (!(row.gap > 0)) throw_bad_input(here, fmt::format("gap is {}; it must be > 0", row.gap));
    if (row.reference_velocity == 0)
      throw_bad_input(here, "reference_velocity is 0; it must be different from 0");
    if (!(row.force * row.reference_velocity < 0) && !table.neighbour_moves)
      throw_bad_input(
          here, fmt::format("force is {} at velocity {}; a drag must be opposed to the velocity",
                            row.force, row.reference_velocity));
    const double stokes = stokes_resistance(table.viscosity, table.radius) * row.reference_velocity;
    row.drag_factor = fields.fields[3].value_or(-row.force / stokes);
    if (!std::isfinite(row.drag_factor))
      throw_bad_input(
          here,
          fmt::format("force is {}, which is {} times Stokes' drag; it must be a finite multiple",
                      row.force, row.drag_factor));
    row.relative_error_estimate = fields.fields[4].value_or(0);
    row.degrees_of_freedom = fields.fields[5].value_or(0);
    row.seconds = fields.fields[6].value_or(0);
    row.observed_order = fields.fields[7].value_or(0);
    if (row.relative_error_estimate < 0)
      throw_bad_input(here, fmt::format("relative_error_estimate is {}; it must be >= 0",
                                        row.relative_error_estimate));
    table.rows.push_back(row);
  }
  if (table.rows.empty())
    throw_bad_input({file}, "has no rows below its header line; it needs at least one");
  return table;
}

std::string write_force_table(const ForceTable& table) {
  CsvComments comments = {
      {"viscontact", "force table"},           {"viscosity", format_number(table.viscosity)},
      {"radius", format_number(table.radius)}, {"geometry", table.geometry},
      {"container", table.container},          {"rows", std::to_string(table.rows.size())}};
  if (table.neighbour_moves) comments[kNeighbourMoves] = "yes";
  if (table.leading_coefficient)
    comments[kLeadingCoefficient] = format_number(*table.leading_coefficient);
  if (!table.case_hash.empty()) comments["case"] = table.case_hash;
  if (!table.tabulated_motions.empty())
    comments[kTabulatedMotions] = motions_in_words(table.tabulated_motions);
  add_failed_rows(comments, table.failed_rows);
  for (const auto& [program, version] : table.versions)
    comments[std::string(kVersionPrefix) + program] = version;
  std::string text = write_csv_comments(comments);
  text += fmt::format("{}\n", fmt::join(kColumns, ","));
  for (const auto& row : table.rows)
    text += fmt::format("{},{},{},{},{},{},{},{}\n", format_number(row.gap),
                        format_number(row.reference_velocity), format_number(row.force),
                        format_number(row.drag_factor), format_number(row.relative_error_estimate),
                        format_number(row.degrees_of_freedom), format_number(row.seconds),
                        format_number(row.observed_order));
  return text;
}

}  // namespace viscontact::lubrication
