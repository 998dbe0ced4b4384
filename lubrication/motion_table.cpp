// Columns, checks and units of tables of force and torque (docs/file-formats.md).
#include "viscontact/lubrication/motion_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <numbers>

#include "viscontact/lubrication/table_codec.hpp"

namespace viscontact::lubrication {
namespace {

/// False if the sphere moves without turning.
bool turns(MotionKind motion) { return motion == MotionKind::kRoll || motion == MotionKind::kSpin; }

}  // namespace

std::vector<Column> columns_of(const TableHead& head, MotionRow& row) {
  constexpr auto kRequired = IfAbsent::kRefused, kZero = IfAbsent::kZero,
                 kComputed = IfAbsent::kComputed;
  std::vector<Column> columns = {
      {"gap", &row.gap, kRequired, kPositive},
      {"reference_velocity", &row.reference_velocity, kRequired, kNotZero},
      {"force", &row.force, kRequired}};
  const auto add = [&](std::vector<Column> further) {
    std::ranges::move(further, std::back_inserter(columns));
  };
  if (head.motion == MotionKind::kApproach)
    add({{"drag_factor", &row.force_factor, kComputed},
         {"relative_error_estimate", &row.relative_error_estimate, kZero, kNotNegative}});
  else
    add({{"torque", &row.torque, kRequired},
         {"force_factor", &row.force_factor, kComputed},
         {"torque_factor", &row.torque_factor, kComputed},
         {"relative_error_estimate", &row.relative_error_estimate, kZero, kNotNegative},
         {"torque_error_estimate", &row.torque_error_estimate, kZero, kNotNegative}});
  add({{"degrees_of_freedom", &row.degrees_of_freedom},
       {"seconds", &row.seconds},
       {"observed_order", &row.observed_order}});
  if (auto& other = row.neighbour)
    add({{"neighbour_force", &other->force, kComputed},
         {"neighbour_torque", &other->torque, kComputed},
         {"neighbour_force_factor", &other->force_factor, kComputed},
         {"neighbour_torque_factor", &other->torque_factor, kComputed},
         {"neighbour_error_estimate", &other->relative_error_estimate, kZero, kNotNegative},
         {"neighbour_torque_error_estimate", &other->torque_error_estimate, kZero, kNotNegative}});
  return columns;
}

void prepare(const TableHead& head, MotionRow& row) {
  if (head.motion != MotionKind::kApproach) row.neighbour.emplace();
}

void complete(const TableHead& head, MotionRow& row) {
  assert(head.viscosity > 0 && head.radius > 0);
  const auto units = action_units(head.motion, head.viscosity, head.radius);
  // `unit` is that of a force or torque per velocity (action_units()).
  const auto one_from_other = [&](double& force, double& factor, double unit) {
    if (std::isnan(factor)) factor = -force / (unit * row.reference_velocity);
    if (std::isnan(force)) force = -unit * row.reference_velocity * factor;
  };
  one_from_other(row.force, row.force_factor, units.force);
  one_from_other(row.torque, row.torque_factor, units.torque);
  if (auto& other = row.neighbour) {
    one_from_other(other->force, other->force_factor, units.force);
    one_from_other(other->torque, other->torque_factor, units.torque);
    if (std::isnan(other->force_factor) || std::isnan(other->torque_factor)) other.reset();
  }
}

void check(const TableHead& head, const MotionRow& row, const FilePosition& here) {
  const bool turning = turns(head.motion);
  const double own = turning ? row.torque : row.force;
  const double factor = turning ? row.torque_factor : row.force_factor;
  if (!head.neighbour_moves && (!(own * row.reference_velocity < 0) ||
                                (head.motion != MotionKind::kApproach && !(factor > 0))))
    throw_bad_input({here.file, here.line, turning ? "torque" : "force"},
                    "{} is {} at velocity {}; a drag must be opposed to the velocity",
                    turning ? "torque" : "force", own, row.reference_velocity);
  const auto check_finite = [&](const char* name, double value, double of_stokes) {
    if (!std::isfinite(of_stokes))
      throw_bad_input({here.file, here.line, name},
                      "{} is {}, which is {} times Stokes' drag; it must be a finite multiple",
                      name, value, of_stokes);
  };
  check_finite("force", row.force, row.force_factor);
  check_finite("torque", row.torque, row.torque_factor);
}

double largest_estimate(const MotionRow& row) {
  const auto other = row.neighbour.value_or(Action{});
  return std::max({row.relative_error_estimate, row.torque_error_estimate,
                   other.relative_error_estimate, other.torque_error_estimate});
}

ActionUnits action_units(MotionKind motion, double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  constexpr double kPi = std::numbers::pi;
  const double length = turns(motion) ? radius : 1;
  return {6 * kPi * viscosity * radius * length, 8 * kPi * viscosity * radius * radius * length};
}

bool is_motion_table(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return false;
  std::ifstream file(path);
  std::string head;
  for (std::string line; std::getline(file, line) && line.starts_with('#');) head += line + "\n";
  auto lines = read_csv_comments(head);
  return lines.contains("motion") ? lines["motion"] != to_string(MotionKind::kApproach)
                                  : lines["viscontact"] == "motion table";
}

MotionTable read_motion_table(const std::filesystem::path& path) {
  return read_table<MotionRow>(path);
}

MotionTable read_force_table(const std::filesystem::path& path) {
  auto table = read_motion_table(path);
  if (table.motion != MotionKind::kApproach)
    throw_bad_input({path.string(), 0, "motion"}, "# motion: is {}; it must be approach here",
                    to_string(table.motion));
  return table;
}

std::string write_motion_table(const MotionTable& table) { return write_table(table); }

}  // namespace viscontact::lubrication
