// Calls the FreeFEM script of a geometry with the argument -motion, and reads what row.idp prints.
#include "viscontact/freefem_axi/motion_row.hpp"

#include <array>
#include <cassert>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "viscontact/common/error.hpp"
#include "viscontact/common/text/number.hpp"

namespace viscontact::freefem_axi {
namespace {

using lubrication::Action;
using lubrication::MotionKind;
using lubrication::MotionRow;

// Force and torque of a sphere alone in unbounded fluid, in units of viscosity, radius and
// velocity. The factors of an Action are force and torque divided by these numbers.
constexpr double kForceUnit = 6 * std::numbers::pi, kTorqueUnit = 8 * std::numbers::pi;

/// A line "viscontact-action": force and torque on one body in one solution.
struct ActionLine {
  /// The solution is the index in motions_of(); body 0 is the sphere, 1 the neighbour.
  std::size_t solution = 0, body = 0;
  /// Force and torque in units of viscosity, radius and velocity; the error estimates of their
  /// factors, over the sphere's force factor if the sphere slides, or over its torque factor if it
  /// turns; and the observed order of convergence.
  std::array<double, 5> numbers{};
};

/// Nothing if a number of a line "viscontact-action" is missing or not finite.
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

/// Force and torque are NaN; complete() computes them from the factors.
Action action_of(const ActionLine& line) {
  // 0 - x is 0 if x is 0, whereas -x is -0 and would be written as "-0".
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {kUnknown,
          kUnknown,
          (0 - line.numbers[0]) / kForceUnit,
          (0 - line.numbers[1]) / kTorqueUnit,
          line.numbers[2],
          line.numbers[3]};
}

/// Copies the lines into `rows`, an element for each solution. Returns false if the lines are not
/// one for each solution and body, in this order.
bool take(const std::vector<ActionLine>& lines, std::size_t bodies, std::vector<MotionRow>& rows) {
  assert(bodies == 1 || bodies == 2);
  if (lines.size() != rows.size() * bodies) return false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].solution != i / bodies || lines[i].body != i % bodies) return false;
    auto& row = rows[lines[i].solution];
    if (lines[i].body == 0) {
      static_cast<Action&>(row) = action_of(lines[i]);
      row.observed_order = lines[i].numbers[4];
    } else {
      row.neighbour = action_of(lines[i]);
    }
  }
  return true;
}

/// The reciprocal theorem says: the forces and torques of rolling, multiplied by the velocities of
/// sliding, give the same power as the forces and torques of sliding, multiplied by the velocities
/// of rolling. Returns |difference of both powers| over what the error estimates allow; more than 1
/// contradicts the theorem. `rows` are those of sliding and rolling.
double asymmetry(const Tabulation& tabulation, const std::vector<MotionRow>& rows) {
  const auto& slide = rows.at(0);
  const auto& roll = rows.at(1);
  double difference = kTorqueUnit * slide.torque_factor - kForceUnit * roll.force_factor;
  double slide_error = slide.torque_error_estimate;
  double roll_error = roll.relative_error_estimate;
  if (slide.neighbour && roll.neighbour) {
    const double moves = neighbour_ratio(tabulation, MotionKind::kSlide);
    const double turns = neighbour_ratio(tabulation, MotionKind::kRoll);
    difference += turns * kTorqueUnit * slide.neighbour->torque_factor -
                  moves * kForceUnit * roll.neighbour->force_factor;
    slide_error += std::abs(turns) * slide.neighbour->torque_error_estimate;
    roll_error += std::abs(moves) * roll.neighbour->relative_error_estimate;
  }
  const double allowed = kTorqueUnit * slide_error * std::abs(slide.force_factor) +
                         kForceUnit * roll_error * std::abs(roll.torque_factor);
  // Without this case, 0/0 would refuse a row whose numbers are all exact.
  return difference == 0 ? 0 : std::abs(difference) / allowed;
}

}  // namespace

std::vector<MotionKind> motions_of(MotionGroup group) {
  if (group == MotionGroup::kAlong) return {MotionKind::kApproach};
  if (group == MotionGroup::kAround) return {MotionKind::kSpin};
  if (group == MotionGroup::kTwofold) return {};
  return {MotionKind::kSlide, MotionKind::kRoll};
}

bool neighbour_is_sphere(const Tabulation& tabulation) {
  const auto& geometry = find_geometry(tabulation.geometry);
  return geometry.curvature != nullptr && geometry.curvature(tabulation.geometry_parameters) > 0;
}

std::vector<MotionRow> solve_motions(const FreeFem& freefem, const Tabulation& tabulation,
                                     MotionGroup group, double gap,
                                     const std::vector<std::string>& further_arguments,
                                     std::string* output) {
  assert(group == MotionGroup::kAcross || group == MotionGroup::kAround);
  const auto start = std::chrono::steady_clock::now();
  auto scaled = tabulation;
  scaled.viscosity = 1;
  auto arguments = row_arguments(scaled, gap, 1);
  arguments.insert(arguments.end(), {"-motion", std::to_string(static_cast<int>(group))});
  arguments.insert(arguments.end(), further_arguments.begin(), further_arguments.end());
  const auto result = run_freefem(freefem, find_geometry(tabulation.geometry).script, arguments);
  if (output != nullptr) *output = result.output;

  const auto motions = motions_of(group);
  std::vector<MotionRow> rows(motions.size());
  std::istringstream answer(line_after(result.output, "viscontact-result"));
  double value = 0, estimate = 0, unknowns = 0;
  answer >> value >> estimate >> unknowns;
  const auto lines = read_action_lines(result.output);
  const std::size_t bodies = neighbour_is_sphere(tabulation) ? 2 : 1;
  if (result.exit_status != 0 || !answer || !lines || !take(*lines, bodies, rows))
    throw Error(ErrorKind::kExternalProgram, "FreeFEM failed at gap {} (exit status {}): {}",
                format_number(gap), result.exit_status,
                failure_in_words(result, freefem.row_limit));
  if (group == MotionGroup::kAcross)
    if (const double excess = asymmetry(tabulation, rows); !(excess <= 1))
      throw Error(ErrorKind::kExternalProgram,
                  "at gap {} the torque of sliding and the force of rolling differ by {:.2g} times "
                  "their error estimates; the matrix must be symmetric",
                  format_number(gap), excess);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    auto& row = rows[i];
    row.gap = gap;
    row.reference_velocity = 1;
    row.degrees_of_freedom = unknowns;
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    lubrication::TableHead head;
    head.motion = motions[i];
    head.viscosity = tabulation.viscosity;
    head.radius = tabulation.radius;
    complete(head, row);
  }
  return rows;
}

}  // namespace viscontact::freefem_axi
