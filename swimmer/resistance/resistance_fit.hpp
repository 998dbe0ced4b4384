// A fit of the resistance matrix of spheres on a line as a function of the gaps between them
// (docs/physics.md (7.2)), and the lubrication between neighbours.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_table.hpp"
#include "viscontact/swimmer/resistance/tensor_polynomial.hpp"

namespace viscontact::swimmer {

/// The largest number of terms of pair_lubrication().
inline constexpr int kLubricationTerms = 3;

/// The singular part of the resistance of two spheres of radii a and b [L], whose surfaces are at
/// the distance gap [L], against a change of this gap, divided by the viscosity [L]:
///
///   6 pi a [ g1/xi + g2 ln(1 + 1/xi) + g3 xi ln(1 + 1/xi) ],   xi = 2 gap/(a + b),
///
/// with the functions g1, g2, g3 of b/a [1] in Jeffrey & Onishi 1984 (J. Fluid Mech. 139, 261,
/// equation (3.17) for X11A). The ln(1/xi) of that equation is replaced by ln(1 + 1/xi), which has
/// the same singularity and stays positive. The value is symmetric in a and b. It is the sum of the
/// first `terms` terms, 0 to kLubricationTerms. Files of fits contain only the rest of R, so that
/// another formula would make them wrong.
double pair_lubrication(double a, double b, double gap, int terms);

/// The resistance matrix, divided by the viscosity [L], of a line of spheres in which only
/// neighbours resist a change of their gap, by pair_lubrication(). It is positive semidefinite.
Eigen::MatrixXd lubrication_matrix(std::span<const double> radii, std::span<const double> gaps,
                                   int terms);

/// The derivative of pair_lubrication() by the gap [1].
double pair_lubrication_slope(double a, double b, double gap, int terms);

/// The fit R = mu (R_lub + l exp(S)) (docs/physics.md (7.2)), with the viscosity mu and the largest
/// radius l. R_lub [L] is lubrication_matrix(). S [1] is symmetric, and each of its entries is a
/// polynomial in all t_k = 1/(gap_k + a_k + a_{k+1}), the inverse distance of the centres of
/// spheres k and k + 1 with radii a_k and a_{k+1}. Therefore R is symmetric and positive definite
/// for any polynomials.
struct ResistanceFit {
  double viscosity = 0;       ///< mu [M/(L T)], > 0
  std::vector<double> radii;  ///< radii of the 2 to 10 spheres along the line [L], > 0
  std::string container;      ///< walls around the fluid, in words; may be empty
  /// Number of terms of pair_lubrication() that are in R_lub.
  int lubrication_terms = 0;
  /// gaps[k] are the nodes of the gap between spheres k and k + 1 [L], > 0 and rising, at least 2.
  /// The degree of S in t_k is one less than the number of nodes.
  std::vector<std::vector<double>> gaps;
  /// The values of S [1] at all combinations of nodes, of which the last gap changes fastest. Each
  /// matrix has a row and a column for each sphere.
  std::vector<Eigen::MatrixXd> logarithms;
  /// Largest relative error |R_ij fitted / R_ij - 1| in the table's rows [1]. It is round-off,
  /// because the polynomials go through all rows. If |R_ij| < 1e-3 sqrt(R_ii R_jj), the error is
  /// divided by 1e-3 sqrt(R_ii R_jj) in place of R_ij.
  double largest_relative_residual = 0;
  /// Relative errors [1] with which a fit of the other rows would predict a row. This fit uses only
  /// those rows that differ from the predicted row in a single gap.
  double largest_left_one_out_error = 0,        ///< the largest
      rms_left_one_out_error = 0;               ///< their root mean square
  std::string table_sha256;                     ///< SHA-256 of the table file; may be empty
  std::map<std::string, std::string> versions;  ///< program name to version
};

/// The fit for spheres of other radii [L] in the same ratios, and another viscosity [M/(L T)].
/// Scaling is possible, because R/(mu l) depends only on the gaps divided by l. Throws
/// Error(kBadInput) if the ratios or the numbers of radii differ.
ResistanceFit scaled_to(ResistanceFit fit, double viscosity, const std::vector<double>& radii);

/// The text of the fit file (JSON, docs/file-formats.md).
std::string write_resistance_fit(const ResistanceFit& fit);

/// Reads a fit file. Throws Error(kBadInput), which names the line, the key and what is allowed.
ResistanceFit read_resistance_fit(const std::filesystem::path& path);

/// `count` >= 2 rising distances of centres from `from` to `to` [L]: the extrema of a Chebyshev
/// polynomial in 1/distance, at which polynomials in 1/distance (ResistanceFit) interpolate well.
/// Both ends are among them.
inline std::vector<double> chebyshev_arms(double from, double to, int count) {
  assert(count >= 2 && 0 < from && from < to);
  std::vector<double> arms;
  for (int i = 0; i < count; ++i) {
    const double share = (1 - std::cos(std::numbers::pi * i / (count - 1))) / 2;
    arms.push_back(1 / ((1 - share) / from + share / to));
  }
  arms.front() = from;
  arms.back() = to;
  return arms;
}

struct ResistanceWithSlopes {
  Eigen::MatrixXd value;                ///< R [M/T], symmetric and positive definite
  std::vector<Eigen::MatrixXd> slopes;  ///< dR/dgap_k [M/(L T)] for each gap k, symmetric
};

class FittedResistance {
 public:
  explicit FittedResistance(const ResistanceFit& fit);

  const std::vector<double>& radii() const { return radii_; }

  /// The smallest and the largest value of gap k, from 0, in the table [L]. Throws
  /// std::out_of_range if there is no gap k.
  std::array<double, 2> gap_interval(std::size_t k) const { return intervals_.at(k); }

  /// True if each gap [L] is within its interval, up to a relative 1e-12 for rounding; false if a
  /// gap is NaN. `gaps` may be only the first gaps of the line.
  bool contains(std::span<const double> gaps) const;

  /// R at these gaps [L]. Throws Error(kBadInput) if a gap is outside those of the table.
  ResistanceWithSlopes operator()(std::span<const double> gaps) const;

 private:
  double viscosity_;
  std::vector<double> radii_;
  int lubrication_terms_;
  std::vector<std::array<double, 2>> intervals_;
  double unit_length_;  ///< the largest radius
  TensorPolynomial logarithm_;
};

}  // namespace viscontact::swimmer
