#include "freefem_axi/tabulation.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <sstream>

#include "common/error.hpp"
#include "common/file.hpp"
#include "common/named.hpp"
#include "common/number.hpp"
#include "fitting/stokes_drag.hpp"

namespace viscontact {
namespace {

constexpr std::array kGeometries = {
    Geometry{"plane", "plane.edp"},
};

// The coarsest mesh and how often it may be refined by 1.5 until the row's accuracy is met
// (drag.idp). On the lecture's case the first two meshes reach 1e-5 (bench/README.md); the fourth
// has 160 000 unknowns.
constexpr int kCoarsestCells = 8;
constexpr int kMostLevels = 4;

// Raised whenever a change of the scripts changes what they compute, so that tables made before are
// made again.
constexpr int kMethod = 1;

/// The end of a program's output, on one line.
std::string last_lines(const std::string& output) {
  constexpr std::size_t kLines = 4;
  std::vector<std::string> lines;
  std::istringstream stream(output);
  for (std::string line; std::getline(stream, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line);
  if (lines.size() > kLines) lines.erase(lines.begin(), lines.end() - kLines);
  return fmt::format("{}", fmt::join(lines, " | "));
}

}  // namespace

const Geometry& find_geometry(std::string_view name) {
  return require_named(kGeometries, name, "geometry");
}

std::string tabulation_hash(const Tabulation& tabulation) {
  std::string text =
      fmt::format("{} {} {} {} {} {} {};", tabulation.geometry, format_number(tabulation.viscosity),
                  format_number(tabulation.radius), format_number(tabulation.container_radius),
                  format_number(tabulation.container_height),
                  format_number(tabulation.relative_accuracy), kMethod);
  for (const double gap : tabulation.gaps) text += " " + format_number(gap);
  text += ";";
  for (const double velocity : tabulation.reference_velocities)
    text += " " + format_number(velocity);
  return sha256(text);
}

ForceTableRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                        double reference_velocity) {
  const auto start = std::chrono::steady_clock::now();
  const auto result = run_freefem(
      freefem, find_geometry(tabulation.geometry).script,
      {"-radius", format_number(tabulation.radius), "-gap", format_number(gap), "-viscosity",
       format_number(tabulation.viscosity), "-velocity", format_number(reference_velocity),
       "-containerRadius", format_number(tabulation.container_radius), "-containerHeight",
       format_number(tabulation.container_height), "-accuracy",
       format_number(tabulation.relative_accuracy), "-cells", std::to_string(kCoarsestCells),
       "-levels", std::to_string(kMostLevels)});

  std::istringstream answer(line_after(result.output, "viscontact-result"));
  std::array<std::string, 3> words;
  for (auto& word : words) answer >> word;
  const auto force = parse_number(words[0]);
  const auto estimate = parse_number(words[1]);
  const auto unknowns = parse_number(words[2]);
  if (result.exit_status != 0 || !force || !estimate || !unknowns) {
    const std::string said = line_after(result.output, "viscontact-error");
    throw Error(ExitCode::kExternalProgram,
                fmt::format("FreeFEM failed at gap {}, velocity {} (exit status {}): {}",
                            format_number(gap), format_number(reference_velocity),
                            result.exit_status, said.empty() ? last_lines(result.output) : said));
  }
  ForceTableRow row;
  row.gap = gap;
  row.reference_velocity = reference_velocity;
  row.force = *force;
  row.drag_factor =
      -*force / (stokes_resistance(tabulation.viscosity, tabulation.radius) * reference_velocity);
  row.relative_error_estimate = *estimate;
  row.degrees_of_freedom = *unknowns;
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

}  // namespace viscontact
