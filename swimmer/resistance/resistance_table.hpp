// The table of resistance matrices of rigid spheres on a line, over the gaps between them
// (physics.md, section 7). freefem_axi/collinear_spheres.hpp writes it and
// fitting/fit_resistance.hpp fits it. Lengths, masses and times are in any one consistent system of
// units. A change must keep the names of the columns and header keys, because published tables use
// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace viscontact::swimmer {

/// The matrix at one set of gaps: F_i = sum_j R_ij U_j, with F_i the force of sphere i on the fluid
/// [M L/T^2] and U_j the velocity of sphere j [L/T], both along the line.
struct ResistanceRow {
  /// gaps[i] [L] > 0: distance between the surfaces of spheres i and i + 1.
  std::vector<double> gaps;
  /// The entries R_ij [M/T] with i <= j: R11, R12, ..., R1N, R22, ..., RNN. R is symmetric and
  /// positive definite.
  std::vector<double> entries;
  /// Estimates of the errors of the entries, relative to the entry [1], >= 0. Errors of an entry
  /// smaller than 1e-3 sqrt(R_ii R_jj) are relative to this value instead.
  std::vector<double> relative_error_estimates;
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh
  double seconds = 0;             ///< wall time of the row [s]
  /// Observed order of convergence in the mesh size [1] of the entry with the largest estimate: 4
  /// in theory, 0 if it was not observed.
  double observed_order = 0;

  /// The largest of relative_error_estimates, 0 if there are none.
  double largest_error_estimate() const;
};

/// A table of resistance matrices of spheres in a line, with the problem that it was computed for.
struct ResistanceTable {
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  std::vector<double> radii;  ///< of the spheres along the line [L], at least 2, > 0
  std::string container;      ///< walls around the fluid, in words; may be empty
  std::string case_hash;      ///< SHA-256 of the inputs; empty if the table has none
  std::map<std::string, std::string> versions;  ///< program name to version
  /// One row for each combination of gaps that was computed.
  std::vector<ResistanceRow> rows;
};

/// The fewest and the most spheres of a table. Ten spheres take 44 s and 3.6 GB a row
/// (bench/README.md).
inline constexpr std::size_t kFewestSpheres = 2,  ///< the fewest
    kMostSpheres = 10;                            ///< the most

/// Position of R_ij in ResistanceRow::entries of `spheres` spheres; i and j count from 0, in any
/// order.
std::size_t entry_position(std::size_t i, std::size_t j, std::size_t spheres);

/// The number of entries on and above the diagonal.
inline std::size_t entry_count(std::size_t spheres) { return spheres * (spheres + 1) / 2; }

/// The names of the columns: gap12, gap23, ..., R11, R12, ..., R11_relative_error_estimate, ...,
/// and the last members of ResistanceRow. Two numbers are separated by "_" if one of them is 10.
std::vector<std::string> resistance_columns(std::size_t spheres);

/// Reads a table. Throws Error(kBadInput) with file and line if a value is missing, not finite or
/// out of range, if a matrix is not positive definite, or if the number of rows is not that of the
/// header. The columns of gaps and entries are required.
ResistanceTable read_resistance_table(const std::filesystem::path& path);

/// The text of the file: lines "# key: value", the line of column names, and the rows. Every number
/// has as many digits as are needed to read the same double back.
std::string write_resistance_table(const ResistanceTable& table);

}  // namespace viscontact::swimmer
