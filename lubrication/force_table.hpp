// The table of the lubrication force F_lub(q, u0) over a grid of gaps q and velocities u0 of the
// sphere, which the tabulation (freefem_axi/) writes and the fit (fitting/) reads. Lengths, masses
// and times are in any one consistent system of units. A change must keep the names of the columns
// and header keys, because published tables use them.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "viscontact/lubrication/failed_rows.hpp"
#include "viscontact/lubrication/motion_kind.hpp"

namespace viscontact::lubrication {

/// The result at one gap and one velocity.
struct ForceTableRow {
  /// q [L], > 0.
  double gap = 0;
  /// u0 [L/T], not 0; < 0 when the sphere approaches.
  double reference_velocity = 0;
  /// F_lub(q, u0) [M L/T^2], > 0 away from the neighbour. Its sign is opposite to that of u0,
  /// unless the neighbour moves and pulls the sphere along.
  double force = 0;
  /// K = -F_lub/(6 pi mu r u0) [1], with the viscosity mu and the radius r of the table.
  double drag_factor = 0;
  /// Estimate of the relative error of `force` [1], >= 0; 0 if the table has none.
  double relative_error_estimate = 0;
  /// Unknowns on the finest mesh.
  double degrees_of_freedom = 0;
  /// Wall time of the row [s].
  double seconds = 0;
  /// Observed order of convergence in the mesh size [1]: 4 in theory, 0 if it was not observed.
  double observed_order = 0;
};

/// A table with the problem that it was computed for. The rows are in the order of computation: all
/// gaps of the first velocity, then those of the next.
struct ForceTable {
  double viscosity = 0;   ///< mu [M/(L T)], > 0
  double radius = 0;      ///< r [L], > 0
  std::string geometry;   ///< what the sphere approaches, in words; may be empty
  std::string container;  ///< walls around the fluid, in words; may be empty
  /// True if the neighbour moves. It may then pull the sphere, so a force along u0 is allowed.
  bool neighbour_moves = false;
  /// Theory's coefficient k of the resistance R = -F_lub/u0 = k/q near contact [M L/T], > 0, if it
  /// is known.
  std::optional<double> leading_coefficient{};
  std::string case_hash;  ///< SHA-256 of the tabulation's inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  /// The motions of the tabulation, if there were several: each has a table of its own.
  std::vector<MotionKind> tabulated_motions{};
  FailedRows failed_rows{};           ///< rows that could not be computed
  std::vector<ForceTableRow> rows{};  ///< at least one
};

/// Reads a table. The columns gap, reference_velocity and force are required; the others may be
/// absent in a table that Viscontact did not write. Throws Error(kBadInput) with file and line if a
/// value is missing, not finite or out of range, or if the number of rows is not that of the header
/// (the file is truncated).
ForceTable read_force_table(const std::filesystem::path& path);

/// The text of the file: lines "# key: value", the line of column names, and the rows. Every number
/// has as many digits as are needed to read the same double back.
std::string write_force_table(const ForceTable& table);

}  // namespace viscontact::lubrication
