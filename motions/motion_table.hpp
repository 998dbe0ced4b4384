// The table of the force and torque on a sphere in one of the motions across the axis or around it
// (sliding, rolling, spinning), over a grid of gaps and velocities. The force is along x, the
// torque about y and the centre of the body, or about z for spinning; z goes from the neighbour to
// the sphere. freefem_axi/motions/ writes these tables and fitting/fit_pair.hpp fits them. Lengths,
// masses and times are in any one consistent system of units. A change must keep the names of the
// columns and header keys, because published tables use them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/lubrication/failed_rows.hpp"
#include "viscontact/lubrication/motion_kind.hpp"

namespace viscontact::motions {

/// The forces and torques at one gap.
struct MotionTableRow {
  double gap = 0;  ///< q [L], > 0
  /// u0 [L/T] of a sphere that slides, w0 [1/T] of one that turns; not 0.
  double reference_velocity = 0;
  lubrication::ActionFactors sphere;                    ///< of force and torque on the sphere
  std::optional<lubrication::ActionFactors> neighbour;  ///< nothing if the neighbour is no sphere
  double degrees_of_freedom = 0;                        ///< unknowns on the finest mesh
  double seconds = 0;                                   ///< wall time of the row [s]
  double observed_order = 0;  ///< observed order of convergence in the mesh size [1]
};

/// A table with the problem that it was computed for. Rows are in the order of computation.
struct MotionTable {
  lubrication::MotionKind motion = lubrication::MotionKind::kSlide;  ///< not kApproach
  double viscosity = 0;                                              ///< mu [M/(L T)], > 0
  double radius = 0;                                                 ///< r [L], > 0
  std::string geometry;          ///< the neighbour in words; may be empty
  std::string container;         ///< walls around the fluid in words; may be empty
  bool neighbour_moves = false;  ///< true if the neighbour has a velocity of its own
  /// Theory's coefficient of ln q (sliding, rolling) or q ln q (spinning) in the force factor and
  /// in the torque factor, with q in the unit of the table; nothing if not known.
  std::optional<double> leading_force_factor,  ///< the coefficient in the force factor
      leading_torque_factor;                   ///< the coefficient in the torque factor
  std::string case_hash;  ///< SHA-256 of the inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions of the tabulation, if there were several: each has a table of its own.
  std::vector<lubrication::MotionKind> tabulated_motions;
  lubrication::FailedRows failed_rows;  ///< rows that could not be computed
  std::vector<MotionTableRow> rows;     ///< at least one
};

/// The units of force and torque of a motion: F = -force * v * (force factor) and T = -torque * v *
/// (torque factor), with the velocity v [L/T] of a sphere that slides or the angular velocity v
/// [1/T] of one that turns.
struct ActionUnits {
  double force = 0;   ///< 6 pi mu r [M/T] or 6 pi mu r^2 [M L/T]
  double torque = 0;  ///< 8 pi mu r^2 [M L/T] or 8 pi mu r^3 [M L^2/T]
};
/// The units of a motion, which is not kApproach, with `viscosity` mu [M/(L T)] and `radius` r [L].
ActionUnits action_units(lubrication::MotionKind motion, double viscosity, double radius);

/// True if the path is a regular file with the first line of a table of write_motion_table(). False
/// for a pipe, which is not read, because it cannot be read a second time.
bool is_motion_table(const std::filesystem::path& path);

/// Reads a table. The columns gap, reference_velocity, force and torque are required. Throws
/// Error(kBadInput) with file and line if a value is missing, not finite or out of range, if the
/// resistance to the motion itself is not positive while the neighbour is at rest, or if the number
/// of rows is not that of the header.
MotionTable read_motion_table(const std::filesystem::path& path);

/// The text of the file: lines "# key: value", the line of column names, and the rows.
std::string write_motion_table(const MotionTable& table);

}  // namespace viscontact::motions
