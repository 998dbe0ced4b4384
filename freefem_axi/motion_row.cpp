// Calls the script of a geometry with -motion and reads its lines "viscontact-action", in which
// viscosity, radius and the velocity of the motion are 1.
#include "viscontact/freefem_axi/motion_row.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::ActionFactors;
using lubrication::MotionKind;

constexpr double kForceUnit = 6 * std::numbers::pi, kTorqueUnit = 8 * std::numbers::pi;

/// A line "viscontact-action": the numbers after solution and body.
struct ActionLine {
  std::size_t solution = 0, body = 0;
  /// Force, torque, their error estimates, observed order.
  std::array<double, 5> numbers{};
};

/// All these lines. Nothing if a number is missing or not finite.
std::optional<std::vector<ActionLine>> read_action_lines(const std::string& output) {
  std::vector<ActionLine> actions;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, word;
    ActionLine action;
    if (!(words >> name >> action.solution >> action.body) || name != "viscontact-action") continue;
    for (double& number : action.numbers) {
      if (!(words >> word)) return {};
      const auto value = parse_number(word);
      if (!value) return {};
      number = *value;
    }
    actions.push_back(action);
  }
  return actions;
}

ActionFactors factors_of(const ActionLine& line) {
  // 0 - x is 0 where x is 0, while -x would be written as -0.
  return {(0 - line.numbers[0]) / kForceUnit, (0 - line.numbers[1]) / kTorqueUnit, line.numbers[2],
          line.numbers[3]};
}

/// Copies the lines into `row`. Returns false if one is missing or occurs twice.
bool take(const std::vector<ActionLine>& lines, std::size_t bodies, MotionRow& row) {
  if (lines.size() != row.results.size() * bodies) return false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].solution != i / bodies || lines[i].body != i % bodies) return false;
    auto& result = row.results[lines[i].solution];
    const auto factors = factors_of(lines[i]);
    if (lines[i].body == 0) {
      result.sphere = factors;
      result.observed_order = lines[i].numbers[4];
    } else {
      result.neighbour = factors;
    }
  }
  return true;
}

/// By the reciprocal theorem the power of the forces of rolling at the velocities of sliding is
/// that of the forces of sliding at the velocities of rolling. Returns the difference of both over
/// what the error estimates allow.
double asymmetry(const Tabulation& tabulation, const MotionRow& row) {
  const auto& slide = row.results.at(0);
  const auto& roll = row.results.at(1);
  double difference = kTorqueUnit * slide.sphere.torque - kForceUnit * roll.sphere.force;
  double slide_error = slide.sphere.torque_error_estimate;
  double roll_error = roll.sphere.force_error_estimate;
  if (slide.neighbour && roll.neighbour) {
    const double moves = neighbour_ratio(tabulation, MotionKind::kSlide);
    const double turns = neighbour_ratio(tabulation, MotionKind::kRoll);
    difference +=
        turns * kTorqueUnit * slide.neighbour->torque - moves * kForceUnit * roll.neighbour->force;
    slide_error += std::abs(turns) * slide.neighbour->torque_error_estimate;
    roll_error += std::abs(moves) * roll.neighbour->force_error_estimate;
  }
  const double allowed = kTorqueUnit * slide_error * std::abs(slide.sphere.force) +
                         kForceUnit * roll_error * std::abs(roll.sphere.torque);
  return std::abs(difference) / allowed;
}

}  // namespace

std::vector<MotionKind> motions_of(MotionGroup group) {
  if (group == MotionGroup::kAround) return {MotionKind::kSpin};
  return {MotionKind::kSlide, MotionKind::kRoll};
}

bool neighbour_is_sphere(const Tabulation& tabulation) {
  const auto& geometry = find_geometry(tabulation.geometry);
  return geometry.curvature != nullptr && geometry.curvature(tabulation.geometry_parameters) > 0;
}

MotionRow solve_motions(const FreeFem& freefem, const Tabulation& tabulation, MotionGroup group,
                        double gap, const std::vector<std::string>& further_arguments,
                        std::string* output) {
  const auto start = std::chrono::steady_clock::now();
  auto scaled = tabulation;
  scaled.viscosity = 1;
  auto arguments = row_arguments(scaled, gap, 1);
  arguments.insert(arguments.end(), {"-motion", std::to_string(static_cast<int>(group))});
  arguments.insert(arguments.end(), further_arguments.begin(), further_arguments.end());
  const auto result = run_freefem(freefem, find_geometry(tabulation.geometry).script, arguments);
  if (output != nullptr) *output = result.output;

  MotionRow row;
  row.results.resize(motions_of(group).size());
  std::istringstream answer(line_after(result.output, "viscontact-result"));
  double value = 0, estimate = 0;
  answer >> value >> estimate >> row.degrees_of_freedom;
  const auto lines = read_action_lines(result.output);
  const std::size_t bodies = neighbour_is_sphere(tabulation) ? 2 : 1;
  if (result.exit_status != 0 || !answer || !lines || !take(*lines, bodies, row))
    throw Error(ErrorKind::kExternalProgram,
                fmt::format("FreeFEM failed at gap {} (exit status {}): {}", format_number(gap),
                            result.exit_status, failure_in_words(result, freefem.row_limit)));
  if (group == MotionGroup::kAcross)
    if (const double excess = asymmetry(tabulation, row); !(excess <= 1))
      throw Error(ErrorKind::kExternalProgram,
                  fmt::format("at gap {} the torque of sliding and the force of rolling differ by "
                              "{:.2g} times their error estimates; the matrix must be symmetric",
                              format_number(gap), excess));
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

}  // namespace viscontact::freefem_axi
