// A fit of the resistance matrix of spheres on a line as a function of the gaps between them
// (physics.md, section 7). Lengths, masses and times are in the units of the table. A change must
// keep the keys of the file, which other programs may read.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// R = mu (L + l exp(S)), where l is the largest radius. L is the lubrication between neighbours
/// (pair_lubrication.hpp): singular, positive semidefinite and known. S is symmetric, and each of its
/// entries is a polynomial in t_k = 1/(gap_k + a_k + a_{k+1}), the inverse distance of centres. So R
/// is symmetric and positive definite for whatever polynomials.
struct ResistanceFit {
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  std::vector<double> radii;  ///< of the spheres along the line [L], > 0
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// Number of terms of the lubrication that are in L, 0 to 3.
  int lubrication_terms = 0;
  /// gaps[k]: the nodes of the gap between spheres k and k + 1 [L], > 0 and rising, at least 2. The
  /// polynomial in t_k has one degree less than there are nodes, and takes the values below there.
  std::vector<std::vector<double>> gaps;
  /// S at all combinations of nodes [1]; the last gap changes fastest.
  std::vector<Eigen::MatrixXd> logarithms;
  /// Largest |R_ij fitted / R_ij - 1| of the table's rows, >= 0: round-off, as the polynomials
  /// interpolate. Entries count as in ResistanceRow::relative_error_estimates.
  double largest_relative_residual = 0;
  /// The same for rows that are predicted from the other rows with the same other gaps, >= 0; the
  /// largest, and the root mean square.
  double largest_left_one_out_error = 0,        ///< the largest
      rms_left_one_out_error = 0;               ///< the root mean square
  std::string table_sha256;                     ///< checksum of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The text of the fit file (JSON).
std::string write_resistance_fit(const ResistanceFit& fit);

/// Reads a fit file. Throws Error(kBadInput) with the line, the key and what is allowed.
ResistanceFit read_resistance_fit(const std::filesystem::path& path);

}  // namespace viscontact::swimmer
