// The table of resistance matrices of rigid spheres on a line, over the gaps between them
// (docs/physics.md, section 7).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/lubrication/table.hpp"

namespace viscontact::swimmer {

/// The matrix R at one set of gaps: F_i = sum_j R_ij U_j, with F_i the force of sphere i on the
/// fluid [M L/T^2] and U_j the velocity of sphere j [L/T], both along the line.
struct ResistanceRow {
  static constexpr bool kIsOfLine = true;  ///< says that the head of the table has several radii
  std::vector<double> gaps;  ///< gaps[i]: gap between the surfaces of spheres i and i + 1 [L], > 0
  /// The entries R_ij [M/T] with i <= j: R11, R12, ..., R1N, R22, ..., RNN, the order in which
  /// collinear_spheres.edp writes them. R is symmetric and positive definite.
  std::vector<double> entries;
  /// Estimates of the errors of the entries, divided by the entry [1]. If |R_ij| < 1e-3 sqrt(R_ii
  /// R_jj), the error of R_ij is divided by 1e-3 sqrt(R_ii R_jj) in place of R_ij.
  std::vector<double> relative_error_estimates;
  double degrees_of_freedom = 0;  ///< unknowns on the finest mesh, >= 0; 0: not known
  double seconds = 0;             ///< computing time of the row on a clock [s]; 0: not known
  /// Order of convergence in the mesh size [1], observed in the entry with the largest error
  /// estimate. It is 4 in theory, and 0 if it was not observed.
  double observed_order = 0;
  double relative_error_estimate = 0;  ///< largest of relative_error_estimates [1]
};

using lubrication::kFewestSpheres;
using lubrication::kMostSpheres;
using ResistanceTable = lubrication::Table<ResistanceRow>;

/// Position of R_ij in ResistanceRow::entries of `spheres` spheres; i and j count from 0, in any
/// order.
std::size_t entry_position(std::size_t i, std::size_t j, std::size_t spheres);

inline std::size_t entry_count(std::size_t spheres) { return spheres * (spheres + 1) / 2; }

/// The symmetric matrix R [M/T] of a row. Throws std::out_of_range if the row has too few entries.
Eigen::MatrixXd matrix_of(const ResistanceRow& row, std::size_t spheres);

/// The columns of a row: gap12, gap23, ..., R11, R12, ..., R11_relative_error_estimate, ...,
/// relative_error_estimate, degrees_of_freedom, seconds and observed_order. Each column points to
/// its number in `row`, which must have the sizes that prepare() sets. In a name the numbers of two
/// spheres are separated by "_" if one of them is 10.
std::vector<lubrication::Column> columns_of(const lubrication::TableHead& head, ResistanceRow& row);

/// Gives the vectors of a row the sizes that belong to the number of radii in the head.
void prepare(const lubrication::TableHead& head, ResistanceRow& row);

void complete(const lubrication::TableHead& head, ResistanceRow& row);

/// Throws Error(kBadInput), which names the file and line of `here`, if the matrix of the row is
/// not positive definite.
void check(const lubrication::TableHead& head, const ResistanceRow& row, const FilePosition& here);

/// The largest of the error estimates of the entries [1], 0 if there are none.
double largest_estimate(const ResistanceRow& row);

/// Reads a table. The columns of gaps and entries are required. Throws Error(kBadInput) with file
/// and line if the file cannot be read, was cut short or has no rows, if a value is missing, not
/// finite or out of range, or if a matrix is not positive definite.
ResistanceTable read_resistance_table(const std::filesystem::path& path);

/// The gaps of each pair of neighbours in the table [L], rising, without repetition.
std::vector<std::vector<double>> gap_grid(const ResistanceTable& table);

/// The ratio [1] of the radii [L]: radii = ratio other. Throws Error(kBadInput) if `radii` is not a
/// multiple of `other` up to rounding, or if the lists differ in length. `what` is the word in the
/// message for the thing that has the radii `other`: "table" or "fit".
double ratio_of_radii(const std::vector<double>& radii, const std::vector<double>& other,
                      std::string_view what);

/// The table for spheres of other radii r' [L], in a fluid of another viscosity mu' [M/(L T)]. A
/// Stokes flow has no length of its own: if r are the radii, mu the viscosity and R(q) the matrix
/// at the gaps q of `table`, and r' = ratio r, the matrix at the gaps ratio q is (mu'/mu) ratio
/// R(q). The container grows with the spheres, and `case_hash` becomes empty. Throws
/// Error(kBadInput) if r' is not a multiple of r.
ResistanceTable scaled_to(ResistanceTable table, double viscosity,
                          const std::vector<double>& radii);

/// The text of the file (CSV) of a table with at least one row.
std::string write_resistance_table(const ResistanceTable& table);

}  // namespace viscontact::swimmer
