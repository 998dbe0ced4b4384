// A fit of the resistance matrix of spheres on a line as a function of the gaps between them
// (physics.md, section 7). Lengths, masses and times are in the units of the table.
// swimmer/fit/fit_resistance.hpp makes it, and fitted_resistance.hpp evaluates it. A change must
// keep the keys of the file, which other programs may read.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_table.hpp"

namespace viscontact::swimmer {

/// R = mu (R_lub + l exp(S)), physics.md (7.2), with the viscosity mu and the largest radius l.
/// R_lub [L] is the lubrication between neighbours (pair_lubrication.hpp), which is known: singular
/// at contact and positive semidefinite. S [1] is symmetric, and each of its entries is a
/// polynomial in t_k = 1/(gap_k + a_k + a_{k+1}), the inverse distance of the centres of spheres k
/// and k + 1 with radii a_k and a_{k+1}. Therefore R is symmetric and positive definite for any
/// polynomials.
struct ResistanceFit {
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  std::vector<double> radii;  ///< of the spheres along the line [L], > 0
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// Number of terms of pair_lubrication() that are in R_lub, 0 to 3.
  int lubrication_terms = 0;
  /// gaps[k]: the nodes of the gap between spheres k and k + 1 [L], > 0 and rising, at least 2. The
  /// degree in t_k is one less than the number of nodes; at the nodes S has the values
  /// `logarithms`.
  std::vector<std::vector<double>> gaps;
  /// S at all combinations of nodes [1]; the last gap changes fastest.
  std::vector<Eigen::MatrixXd> logarithms;
  /// Largest |R_ij fitted / R_ij - 1| of the table's rows, >= 0. It is round-off, because the
  /// polynomials interpolate. A small entry counts as in ResistanceRow::relative_error_estimates.
  double largest_relative_residual = 0;
  /// That error of a row that is predicted from the rows that differ from it in one gap only, >= 0.
  double largest_left_one_out_error = 0,        ///< the largest
      rms_left_one_out_error = 0;               ///< the root mean square
  std::string table_sha256;                     ///< checksum of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The fit for spheres of other radii [L] > 0 in the same ratios, and another viscosity [M/(L T)] >
/// 0. R/(mu l) depends on the gaps in units of l alone. Throws Error(kBadInput) if the ratios
/// differ.
ResistanceFit scaled_to(ResistanceFit fit, double viscosity, const std::vector<double>& radii);

/// The text of the fit file (JSON).
std::string write_resistance_fit(const ResistanceFit& fit);

/// Reads a fit file. Throws Error(kBadInput) with the line, the key and what is allowed.
ResistanceFit read_resistance_fit(const std::filesystem::path& path);

}  // namespace viscontact::swimmer
