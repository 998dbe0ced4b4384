// The table that the tabulation writes and the fit reads: the lubrication force over a grid of gaps
// and velocities.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace viscontact {

/// One solved (gap, velocity). Dimensions: [L], [L/T], [M L/T^2], 1, 1, count, s, 1.
struct ForceTableRow {
  double gap = 0;                 ///< q > 0
  double reference_velocity = 0;  ///< u0, not 0; negative: approaching
  double force = 0;  ///< F_lub(q, u0) along the outward normal: opposite in sign to u0, unless the
                     ///< neighbour moves and pulls
  double drag_factor = 0;              ///< lambda = -F_lub / (6 pi mu r u0)
  double relative_error_estimate = 0;  ///< of force, >= 0
  double degrees_of_freedom = 0;       ///< unknowns on the finest mesh
  double seconds = 0;                  ///< wall time of the row
  double observed_order = 0;  ///< of convergence in the mesh size; 4 in theory, 0: not observed
};

/// A table with what it was computed for. Rows are in the order of computation: gaps within
/// velocities.
struct ForceTable {
  double viscosity = 0;   ///< mu [M/(L T)], > 0
  double radius = 0;      ///< r [L], > 0
  std::string geometry;   ///< what the sphere approaches, in words; empty in a user's own table
  std::string container;  ///< in words
  bool neighbour_moves = false;  ///< it may pull: the force may then be along the velocity
  std::optional<double>
      leading_coefficient{};  ///< theory's k of R ~ k/q near contact [M L/T], if it is known
  std::string case_hash;      ///< SHA-256 of the tabulation's inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  std::vector<ForceTableRow> rows;
};

/// Reads a table. The columns gap, reference_velocity and force are needed; the other ones may be
/// absent in a user's own table. Throws Error(kBadInput) with file and line where a value is
/// missing, not finite or out of range, and when the rows are not as many as the header says (a
/// truncated file).
ForceTable read_force_table(const std::filesystem::path& path);

/// The text of the file: "# key: value" lines, header, rows; every number in its shortest
/// round-trip form.
std::string write_force_table(const ForceTable& table);

}  // namespace viscontact
