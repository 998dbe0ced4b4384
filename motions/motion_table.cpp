// Reads and writes the CSV file of a motion table (docs/file-formats.md). Lengths, masses and times
// are in any one consistent system of units. A change must keep published tables readable.
#include "viscontact/motions/motion_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "viscontact/common/text/csv.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::motions {
namespace {

// The columns that are read. The first four are required.
const std::array<std::string, 15> kMotionColumns = {"gap",
                                                    "reference_velocity",
                                                    "force",
                                                    "torque",
                                                    "force_factor",
                                                    "torque_factor",
                                                    "relative_error_estimate",
                                                    "torque_error_estimate",
                                                    "degrees_of_freedom",
                                                    "seconds",
                                                    "observed_order",
                                                    "neighbour_force_factor",
                                                    "neighbour_torque_factor",
                                                    "neighbour_error_estimate",
                                                    "neighbour_torque_error_estimate"};
constexpr std::size_t kRequiredOfMotion = 4;
constexpr std::string_view kOfSphere =
    "gap,reference_velocity,force,torque,force_factor,torque_factor,relative_error_estimate,"
    "torque_error_estimate,degrees_of_freedom,seconds,observed_order";
constexpr std::string_view kOfNeighbour =
    ",neighbour_force,neighbour_torque,neighbour_force_factor,neighbour_torque_factor,"
    "neighbour_error_estimate,neighbour_torque_error_estimate";
constexpr std::string_view kKind = "motion table", kProgramPrefix = "version of ";

using MotionFields = std::span<const std::optional<double>>;

void require(bool holds, const FilePosition& here, const std::string& column, double value,
             std::string_view what) {
  if (!holds) throw_bad_input(here, fmt::format("{} is {}; it must be {}", column, value, what));
}

/// The four fields from `first` on: the factors of a body and their error estimates.
lubrication::ActionFactors factors_of(MotionFields fields, std::size_t first,
                                      const FilePosition& here) {
  const lubrication::ActionFactors factors = {
      fields[first].value_or(0), fields[first + 1].value_or(0), fields[first + 2].value_or(0),
      fields[first + 3].value_or(0)};
  require(factors.force_error_estimate >= 0, here, kMotionColumns.at(first + 2),
          factors.force_error_estimate, ">= 0");
  require(factors.torque_error_estimate >= 0, here, kMotionColumns.at(first + 3),
          factors.torque_error_estimate, ">= 0");
  return factors;
}

MotionTableRow motion_row_of(MotionFields fields, const MotionTable& table,
                             const FilePosition& here) {
  for (std::size_t i = 0; i < kRequiredOfMotion; ++i)
    if (!fields[i]) throw_bad_input(here, kMotionColumns.at(i) + " is empty; it must be a number");
  MotionTableRow row;
  row.gap = *fields[0];
  row.reference_velocity = *fields[1];
  require(row.gap > 0, here, "gap", row.gap, "> 0");
  require(row.reference_velocity != 0, here, "reference_velocity", 0, "different from 0");
  const auto units = action_units(table.motion, table.viscosity, table.radius);
  row.sphere = factors_of(fields, 4, here);
  if (!fields[4]) row.sphere.force = -*fields[2] / (units.force * row.reference_velocity);
  if (!fields[5]) row.sphere.torque = -*fields[3] / (units.torque * row.reference_velocity);
  const bool slides = table.motion == lubrication::MotionKind::kSlide;
  const double resistance = slides ? row.sphere.force : row.sphere.torque;
  if (!std::isfinite(row.sphere.force) || !std::isfinite(row.sphere.torque) ||
      (!(resistance > 0) && !table.neighbour_moves))
    throw_bad_input(here, fmt::format("{} is {} at velocity {}; it must be opposed to the velocity",
                                      slides ? "force" : "torque", *fields[slides ? 2 : 3],
                                      row.reference_velocity));
  if (fields[11] && fields[12]) row.neighbour = factors_of(fields, 11, here);
  row.degrees_of_freedom = fields[8].value_or(0);
  row.seconds = fields[9].value_or(0);
  row.observed_order = fields[10].value_or(0);
  return row;
}

/// The columns of a body: force, torque, and the four columns that factors_of() reads.
std::string action_text(const lubrication::ActionFactors& body, const ActionUnits& units,
                        double velocity) {
  return fmt::format("{},{},{},{},{},{}", format_number(-units.force * velocity * body.force),
                     format_number(-units.torque * velocity * body.torque),
                     format_number(body.force), format_number(body.torque),
                     format_number(body.force_error_estimate),
                     format_number(body.torque_error_estimate));
}

std::optional<double> optional_comment(const CsvComments& comments, const std::string& key,
                                       const std::string& file) {
  if (!comments.contains(key)) return {};
  return csv_comment_number(comments, key, file);
}

}  // namespace

ActionUnits action_units(lubrication::MotionKind motion, double viscosity, double radius) {
  constexpr double kPi = std::numbers::pi;
  const double length = motion == lubrication::MotionKind::kSlide ? 1 : radius;
  return {6 * kPi * viscosity * radius * length, 8 * kPi * viscosity * radius * radius * length};
}

bool is_motion_table(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line) && line.starts_with('#');)
    if (line.starts_with(fmt::format("# viscontact: {}", kKind))) return true;
  return false;
}

MotionTable read_motion_table(const std::filesystem::path& path) {
  const std::string file = path.string();
  // The rows can be converted only after the head of the file was read, which has viscosity and
  // radius.
  std::vector<std::pair<std::vector<std::optional<double>>, int>> lines;
  CsvComments comments;
  std::set<std::string> contradictions;
  read_csv_rows(path, kMotionColumns, kRequiredOfMotion, comments, contradictions,
                [&](MotionFields fields, int line) {
                  lines.emplace_back(std::vector(fields.begin(), fields.end()), line);
                });
  MotionTable table;
  for (const char* key : {"motion", "viscosity", "radius"})
    if (contradictions.contains(key))
      throw_bad_input(
          {file}, fmt::format("# {}: stands twice with different values; it must stand once", key));
  if (!comments.contains("motion"))
    throw_bad_input({file}, "has no line '# motion: ...'; it must name slide, roll or spin");
  table.motion = with_place(file + ": # motion",
                            [&] { return lubrication::parse_motion(comments["motion"]); });
  if (table.motion == lubrication::MotionKind::kApproach)
    throw_bad_input({file},
                    "# motion: is approach; it must be slide, roll or spin, because tables "
                    "of the approach have other columns");
  table.viscosity = csv_comment_number(comments, "viscosity", file);
  table.radius = csv_comment_number(comments, "radius", file);
  require(table.viscosity > 0, {file}, "# viscosity:", table.viscosity, "> 0");
  require(table.radius > 0, {file}, "# radius:", table.radius, "> 0");
  table.geometry = comments["geometry"];
  table.container = comments["container"];
  table.neighbour_moves = comments["neighbour_moves"] == "yes";
  table.leading_force_factor = optional_comment(comments, "leading_force_factor", file);
  table.leading_torque_factor = optional_comment(comments, "leading_torque_factor", file);
  table.case_hash = comments["case"];
  table.tabulated_motions = with_place(file + ": # motions", [&] {
    return lubrication::parse_motions_in_words(comments["motions"]);
  });
  table.failed_rows = lubrication::failed_rows_in(comments);
  for (const auto& [key, value] : comments)
    if (key.starts_with(kProgramPrefix)) table.versions[key.substr(kProgramPrefix.size())] = value;
  for (const auto& [fields, line] : lines)
    table.rows.push_back(motion_row_of(fields, table, {file, line}));
  if (table.rows.empty())
    throw_bad_input({file}, "has no rows below its header line; it needs at least one");
  return table;
}

std::string write_motion_table(const MotionTable& table) {
  CsvComments comments = {{"viscontact", std::string(kKind)},
                          {"motion", std::string(lubrication::to_string(table.motion))},
                          {"viscosity", format_number(table.viscosity)},
                          {"radius", format_number(table.radius)},
                          {"geometry", table.geometry},
                          {"container", table.container},
                          {"rows", std::to_string(table.rows.size())}};
  if (table.neighbour_moves) comments["neighbour_moves"] = "yes";
  if (table.leading_force_factor)
    comments["leading_force_factor"] = format_number(*table.leading_force_factor);
  if (table.leading_torque_factor)
    comments["leading_torque_factor"] = format_number(*table.leading_torque_factor);
  if (!table.case_hash.empty()) comments["case"] = table.case_hash;
  if (!table.tabulated_motions.empty())
    comments["motions"] = lubrication::motions_in_words(table.tabulated_motions);
  lubrication::add_failed_rows(comments, table.failed_rows);
  for (const auto& [program, version] : table.versions)
    comments[std::string(kProgramPrefix) + program] = version;
  const bool has_neighbour = !table.rows.empty() && table.rows.front().neighbour;
  std::string text = write_csv_comments(comments);
  text += fmt::format("{}{}\n", kOfSphere, has_neighbour ? kOfNeighbour : "");
  const auto units = action_units(table.motion, table.viscosity, table.radius);
  for (const auto& row : table.rows) {
    text += fmt::format("{},{},{},{},{},{}", format_number(row.gap),
                        format_number(row.reference_velocity),
                        action_text(row.sphere, units, row.reference_velocity),
                        format_number(row.degrees_of_freedom), format_number(row.seconds),
                        format_number(row.observed_order));
    if (has_neighbour) text += "," + action_text(*row.neighbour, units, row.reference_velocity);
    text += "\n";
  }
  return text;
}

}  // namespace viscontact::motions
