// Makes the arguments of a FreeFEM script, runs it and reads the result.
#include "viscontact/freefem_axi/tabulation.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"
#include "viscontact/lubrication/stokes_drag.hpp"

namespace viscontact::freefem_axi {
namespace {

/// The first numbers of the line "viscontact-result" of a script: the force in the units of
/// solve_scale(), its relative error estimate, the number of unknowns, and the observed order.
struct Answer {
  double force = 0, estimate = 0, unknowns = 0, order = 0;
};

/// Throws Error(kExternalProgram), which names gap and velocity, if FreeFEM failed, was killed
/// after `time_limit`, or did not print the line.
Answer read_answer(const ProcessResult& result, double gap, double reference_velocity,
                   std::chrono::seconds time_limit) {
  std::istringstream answer(line_after(result.output, "viscontact-result"));
  std::array<std::string, 4> words;
  for (auto& word : words) answer >> word;
  const auto force = parse_number(words[0]);
  const auto estimate = parse_number(words[1]);
  const auto unknowns = parse_number(words[2]);
  const auto order = parse_number(words[3]);
  if (result.exit_status == 0 && force && estimate && unknowns && order)
    return {*force, *estimate, *unknowns, *order};
  throw Error(ErrorKind::kExternalProgram,
              "FreeFEM failed at gap {}, velocity {} (exit status {}): {}", format_number(gap),
              format_number(reference_velocity), result.exit_status,
              failure_in_words(result, time_limit));
}

}  // namespace

std::string container_in_words(const Tabulation& tabulation) {
  if (!find_geometry(tabulation.geometry).takes_container) return "none";
  if (!tabulation.container) return "unbounded";
  return fmt::format("closed cylinder, radius {}, height {}",
                     format_number(tabulation.container->radius),
                     format_number(tabulation.container->height));
}

std::string geometry_in_words(const Tabulation& tabulation) {
  const auto& geometry = find_geometry(tabulation.geometry);
  std::string words(geometry.name);
  for (std::size_t i = 0; i < geometry.parameters.size(); ++i) {
    const auto& parameter = geometry.parameters[i];
    const double value = tabulation.geometry_parameters.at(i);
    if (parameter.is_named_if_given && value == parameter.fallback) continue;
    words += fmt::format(", {} {}", parameter.key, format_number(value));
  }
  return words;
}

double neighbour_ratio(const Tabulation& tabulation, lubrication::MotionKind motion) {
  const auto& geometry = find_geometry(tabulation.geometry);
  if (geometry.neighbour_ratio == nullptr) return 0;
  return geometry.neighbour_ratio(motion, tabulation.geometry_parameters);
}

std::optional<double> leading_coefficient(const Tabulation& tabulation) {
  const auto& geometry = find_geometry(tabulation.geometry);
  if (geometry.leading_factor == nullptr) return std::nullopt;
  const double coefficient =
      lubrication::stokes_resistance(tabulation.viscosity, tabulation.radius) * tabulation.radius *
      geometry.leading_factor(tabulation.radius, tabulation.geometry_parameters);
  // A table cannot contain an infinite coefficient. It contains none if the coefficient is <= 0,
  // because the neighbour then moves away at least as fast as the sphere follows.
  if (!std::isfinite(coefficient) || !(coefficient > 0)) return std::nullopt;
  return coefficient;
}

std::vector<std::string> row_arguments(const Tabulation& tabulation, double gap,
                                       double reference_velocity) {
  const auto& geometry = find_geometry(tabulation.geometry);
  std::vector<std::string> arguments = {"-radius",    format_number(tabulation.radius),
                                        "-gap",       format_number(gap),
                                        "-viscosity", format_number(tabulation.viscosity),
                                        "-velocity",  format_number(reference_velocity)};
  append_mesh_arguments(arguments, tabulation.relative_accuracy);
  if (geometry.takes_container) {
    const auto container = tabulation.container.value_or(Container{});  // 0 means unbounded
    arguments.insert(arguments.end(), {"-containerRadius", format_number(container.radius),
                                       "-containerHeight", format_number(container.height)});
  }
  for (std::size_t i = 0; i < geometry.parameters.size(); ++i)
    arguments.insert(arguments.end(), {std::string(geometry.parameters[i].flag),
                                       format_number(tabulation.geometry_parameters.at(i))});
  return arguments;
}

SolveScale solve_scale(const Tabulation& tabulation, double reference_velocity) {
  // Other limits work, too, if the products of viscosity and speed within them stay normal doubles.
  constexpr double kLeast = 1e-9, kMost = 1e9;
  const double speed = std::abs(reference_velocity);
  const auto is_ordinary = [](double value) { return value >= kLeast && value <= kMost; };
  if (is_ordinary(tabulation.viscosity) && is_ordinary(speed)) return {};
  return {tabulation.viscosity, speed};
}

lubrication::MotionRow solve_row(const FreeFem& freefem, const Tabulation& tabulation, double gap,
                                 double reference_velocity,
                                 const std::vector<std::string>& further_arguments,
                                 std::string* output) {
  const auto start = std::chrono::steady_clock::now();
  const auto scale = solve_scale(tabulation, reference_velocity);
  auto scaled = tabulation;
  scaled.viscosity = tabulation.viscosity / scale.viscosity;
  const double scaled_velocity = reference_velocity / scale.speed;
  auto arguments = row_arguments(scaled, gap, scaled_velocity);
  arguments.insert(arguments.end(), further_arguments.begin(), further_arguments.end());
  const auto result = run_freefem(freefem, find_geometry(tabulation.geometry).script, arguments);
  if (output != nullptr) *output = result.output;
  const auto [force, estimate, unknowns, order] =
      read_answer(result, gap, reference_velocity, freefem.row_limit);

  lubrication::MotionRow row;
  row.gap = gap;
  row.reference_velocity = reference_velocity;
  row.force = force * scale.viscosity * scale.speed;
  if (!std::isnormal(row.force))
    throw Error(ErrorKind::kBadInput,
                "the force at gap {}, velocity {} is {} * {} * {}, which a double cannot hold; "
                "choose units in which viscosity and velocity are nearer to 1",
                format_number(gap), format_number(reference_velocity), force, scale.viscosity,
                scale.speed);
  row.force_factor = -force / (lubrication::stokes_resistance(scaled.viscosity, tabulation.radius) *
                               scaled_velocity);
  row.relative_error_estimate = estimate;
  row.degrees_of_freedom = unknowns;
  row.observed_order = order;
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

}  // namespace viscontact::freefem_axi
