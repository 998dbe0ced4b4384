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

/// The loads in the flow of a motion; an axial flow also has a trace.
struct LoadsOfMotion {
  bool force, torque, stresslet;
};
LoadsOfMotion loads_of(MotionKind motion) {
  switch (motion) {
    case MotionKind::kApproach:
    case MotionKind::kAxialStrain:
      return {true, false, true};
    case MotionKind::kSpin:
      return {true, true, false};  // tables of spinning have a force, which is 0
    case MotionKind::kTwofoldStrain:
      return {false, false, true};
    case MotionKind::kSlide:
    case MotionKind::kRoll:
    case MotionKind::kShearStrain:
      return {true, true, true};
  }
  assert(false);
  return {};
}

/// False if the sphere moves without turning.
bool turns(MotionKind motion) { return motion == MotionKind::kRoll || motion == MotionKind::kSpin; }

}  // namespace

std::vector<Column> columns_of(const TableHead& head, MotionRow& row) {
  constexpr auto kRequired = IfAbsent::kRefused, kZero = IfAbsent::kZero,
                 kComputed = IfAbsent::kComputed;
  const auto loads = loads_of(head.motion);
  const bool strained = is_strain(head.motion);
  std::vector<Column> columns;
  const auto add = [&](bool exists, std::vector<Column> further) {
    if (exists) std::ranges::move(further, std::back_inserter(columns));
  };
  add(true, {{"gap", &row.gap, kRequired, kPositive},
             {"reference_velocity", &row.reference_velocity, kRequired, kNotZero}});
  add(loads.force, {{"force", &row.force, kRequired}});
  add(loads.torque, {{"torque", &row.torque, kRequired}});
  add(strained, {{"stresslet", &row.stresslet, kRequired}});
  add(loads.force, {{head.motion == MotionKind::kApproach ? "drag_factor" : "force_factor",
                     &row.force_factor, kComputed}});
  add(loads.torque, {{"torque_factor", &row.torque_factor, kComputed}});
  add(loads.force,
      {{"relative_error_estimate", &row.relative_error_estimate, kZero, kNotNegative}});
  add(loads.torque, {{"torque_error_estimate", &row.torque_error_estimate, kZero, kNotNegative}});
  add(true, {{"degrees_of_freedom", &row.degrees_of_freedom},
             {"seconds", &row.seconds},
             {"observed_order", &row.observed_order}});
  // Columns of later versions follow at the end.
  if (auto& other = row.neighbour) {
    add(loads.force, {{"neighbour_force", &other->force, kComputed}});
    add(loads.torque, {{"neighbour_torque", &other->torque, kComputed}});
    add(loads.force, {{"neighbour_force_factor", &other->force_factor, kComputed}});
    add(loads.torque, {{"neighbour_torque_factor", &other->torque_factor, kComputed}});
    add(loads.force,
        {{"neighbour_error_estimate", &other->relative_error_estimate, kZero, kNotNegative}});
    add(loads.torque,
        {{"neighbour_torque_error_estimate", &other->torque_error_estimate, kZero, kNotNegative}});
  }
  if (!row.has_stresslets) return columns;
  const auto add_moments = [&](const std::string& whose, Action& on, bool is_required) {
    add(loads.stresslet && !is_required, {{whose + "stresslet", &on.stresslet, kComputed}});
    add(loads.stresslet,
        {{whose + "stresslet_factor", &on.stresslet_factor, kComputed},
         {whose + "stresslet_error_estimate", &on.stresslet_error_estimate, kZero, kNotNegative}});
    add(row.has_traces,
        {{whose + "trace", &on.trace, kComputed},
         {whose + "trace_factor", &on.trace_factor, kComputed},
         {whose + "trace_error_estimate", &on.trace_error_estimate, kZero, kNotNegative}});
  };
  add_moments("", row, strained);
  if (auto& other = row.neighbour) add_moments("neighbour_", *other, false);
  add(true, {{"largest_error_estimate", &row.largest_error_estimate, kComputed, kNotNegative}});
  return columns;
}

void prepare(const TableHead& head, MotionRow& row) {
  row.neighbour.emplace();
  row.has_stresslets = true;
  row.has_traces = is_axial(head.motion);
}

void complete(const TableHead& head, MotionRow& row) {
  assert(head.viscosity > 0 && head.radius > 0);
  const auto units = action_units(head.motion, head.viscosity, head.radius);
  // `unit` is that of a load per velocity (action_units()), with its sign.
  const auto one_from_other = [&](double& load, double& factor, double unit) {
    if (std::isnan(factor)) factor = load / (unit * row.reference_velocity);
    if (std::isnan(load)) load = unit * row.reference_velocity * factor;
  };
  const auto complete_action = [&](Action& on) {
    one_from_other(on.force, on.force_factor, -units.force);
    one_from_other(on.torque, on.torque_factor, -units.torque);
    one_from_other(on.stresslet, on.stresslet_factor, units.stresslet);
    one_from_other(on.trace, on.trace_factor, units.stresslet);
  };
  complete_action(row);
  if (auto& other = row.neighbour) complete_action(*other);
  if (row.neighbour &&
      (std::isnan(row.neighbour->force_factor) || std::isnan(row.neighbour->torque_factor) ||
       (is_strain(head.motion) && std::isnan(row.neighbour->stresslet_factor))))
    row.neighbour.reset();
  const auto other = row.neighbour.value_or(Action{});
  if (std::isnan(row.trace_factor) || std::isnan(other.trace_factor)) row.has_traces = false;
  const bool spins_alone =
      head.motion == MotionKind::kSpin && std::isnan(row.largest_error_estimate);
  if (spins_alone || std::isnan(row.stresslet_factor) || std::isnan(other.stresslet_factor))
    row.has_stresslets = row.has_traces = false;
  if (std::isnan(row.largest_error_estimate)) row.largest_error_estimate = 0;
}

void check(const TableHead& head, const MotionRow& row, const FilePosition& here) {
  const auto check_finite = [&](const char* name, double value, double of_stokes) {
    if (!std::isfinite(of_stokes))
      throw_bad_input({here.file, here.line, name},
                      "{} is {}, which is {} times Stokes' drag; it must be a finite multiple",
                      name, value, of_stokes);
  };
  if (is_strain(head.motion)) {
    if (!(row.stresslet * row.reference_velocity > 0))
      throw_bad_input({here.file, here.line, "stresslet"},
                      "stresslet is {} at the rate of strain {}; both must have the same sign",
                      row.stresslet, row.reference_velocity);
    check_finite("stresslet", row.stresslet, row.stresslet_factor);
  } else {
    const bool turning = turns(head.motion);
    const double own = turning ? row.torque : row.force;
    const double factor = turning ? row.torque_factor : row.force_factor;
    if (!head.neighbour_moves && (!(own * row.reference_velocity < 0) ||
                                  (head.motion != MotionKind::kApproach && !(factor > 0))))
      throw_bad_input({here.file, here.line, turning ? "torque" : "force"},
                      "{} is {} at velocity {}; a drag must be opposed to the velocity",
                      turning ? "torque" : "force", own, row.reference_velocity);
  }
  check_finite("force", row.force, row.force_factor);
  check_finite("torque", row.torque, row.torque_factor);
}

double largest_estimate(const MotionRow& row) {
  if (row.has_stresslets) return row.largest_error_estimate;
  const auto other = row.neighbour.value_or(Action{});
  return std::max({row.relative_error_estimate, row.torque_error_estimate,
                   other.relative_error_estimate, other.torque_error_estimate});
}

ActionUnits action_units(MotionKind motion, double viscosity, double radius) {
  assert(viscosity > 0 && radius > 0);
  constexpr double kPi = std::numbers::pi;
  const double length = turns(motion) || is_strain(motion) ? radius : 1;
  return {6 * kPi * viscosity * radius * length, 8 * kPi * viscosity * radius * radius * length,
          20 * kPi / 3 * viscosity * radius * radius * length};
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
