// The columns of a table of force and torque on a sphere, and the checks of its numbers
// (docs/file-formats.md). In the units of the table, gaps [L] are > 0, velocities [L/T] or [1/T]
// not 0, forces in [M L/T^2], torques in [M L^2/T^2], factors and error estimates without
// dimension, estimates >= 0. A number that is missing or of the wrong sign, or a factor that is not
// finite, is an Error(kBadInput) with file and line. A file that does not exist is an
// Error(kBadInput) with its path. freefem_axi/ makes the rows; fitting/, motions/, pipeline/,
// python/ and results/ read tables. A change must keep the names and the order of the columns,
// which published tables have.
#include "viscontact/lubrication/motion_table.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "viscontact/lubrication/table_codec.hpp"

namespace viscontact::lubrication {
namespace {

/// True if the sphere turns, so that its velocity is an angular velocity [1/T]; false if it moves.
bool turns(MotionKind motion) { return motion == MotionKind::kRoll || motion == MotionKind::kSpin; }

}  // namespace

/// The columns in the order of the file, each with the address of its number in `row`. Forces are
/// in [M L/T^2], torques in [M L^2/T^2], the time `seconds` in [s]; factors, error estimates, the
/// number of unknowns and the order of convergence have no dimension. Numbers without a range here
/// may be any finite ones.
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

/// Gives `row` numbers of the neighbour, unless the motion is the approach.
void prepare(const TableHead& head, MotionRow& row) {
  if (head.motion != MotionKind::kApproach) row.neighbour.emplace();
}

/// Computes forces and torques that are NaN from their factors, and factors that are NaN from
/// forces and torques. Removes a neighbour without factors. Throws nothing.
void complete(const TableHead& head, MotionRow& row) {
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

/// Throws Error(kBadInput) with the position `here` if a factor is not finite, or if the neighbour
/// is at rest and the drag (the force on a sphere that moves, the torque on one that turns) does
/// not oppose the velocity.
void check(const TableHead& head, const MotionRow& row, const FilePosition& here) {
  const bool turning = turns(head.motion);
  const double own = turning ? row.torque : row.force;
  const double factor = turning ? row.torque_factor : row.force_factor;
  if (!head.neighbour_moves && (!(own * row.reference_velocity < 0) ||
                                (head.motion != MotionKind::kApproach && !(factor > 0))))
    throw_bad_input(here, "{} is {} at velocity {}; a drag must be opposed to the velocity",
                    turning ? "torque" : "force", own, row.reference_velocity);
  const auto check_finite = [&](const char* name, double value, double of_stokes) {
    if (!std::isfinite(of_stokes))
      throw_bad_input(here,
                      "{} is {}, which is {} times Stokes' drag; it must be a finite multiple",
                      name, value, of_stokes);
  };
  check_finite("force", row.force, row.force_factor);
  check_finite("torque", row.torque, row.torque_factor);
}

/// The largest of the four relative error estimates of the row [1], >= 0; 0 if none is known.
double largest_estimate(const MotionRow& row) {
  const auto other = row.neighbour.value_or(Action{});
  return std::max({row.relative_error_estimate, row.torque_error_estimate,
                   other.relative_error_estimate, other.torque_error_estimate});
}

/// The units of force and torque per velocity. A force is minus its unit times the velocity times
/// the force factor, and a torque is minus its unit times the velocity times the torque factor. The
/// units are in [M/T] and [M L/T] if the sphere moves, in [M L/T] and [M L^2/T] if it turns.
/// Viscosity [M/(L T)] and radius [L] must be > 0, which is not checked.
ActionUnits action_units(MotionKind motion, double viscosity, double radius) {
  constexpr double kPi = std::numbers::pi;
  const double length = turns(motion) ? radius : 1;
  return {6 * kPi * viscosity * radius * length, 8 * kPi * viscosity * radius * radius * length};
}

/// True if the head of the file says that the motion is another one than the approach. False also
/// for a pipe, and for a file that cannot be opened. A path that the system cannot look up throws
/// std::filesystem::filesystem_error.
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

/// Reads a table of the approach. Throws Error(kBadInput) for another motion, too.
MotionTable read_force_table(const std::filesystem::path& path) {
  auto table = read_motion_table(path);
  if (table.motion != MotionKind::kApproach)
    throw_bad_input({path.string()}, "# motion: is {}; it must be approach here",
                    to_string(table.motion));
  return table;
}

std::string write_motion_table(const MotionTable& table) { return write_table(table); }

}  // namespace viscontact::lubrication
