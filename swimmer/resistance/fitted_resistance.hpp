// The resistance matrix R of spheres on a line at any gaps between them, from a fit
// (resistance_fit.hpp), for the mechanics of the swimmer. Lengths, masses and times are in the
// units of the fit. R must stay symmetric and positive definite, slopes its derivatives.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "viscontact/swimmer/resistance/resistance_fit.hpp"
#include "viscontact/swimmer/resistance/tensor_polynomial.hpp"

namespace viscontact::swimmer {

/// R and its derivatives.
struct ResistanceWithSlopes {
  Eigen::MatrixXd value;                ///< R [M/T], symmetric and positive definite
  std::vector<Eigen::MatrixXd> slopes;  ///< dR/dgap_k [M/(L T)] for each gap
};

/// Evaluates a ResistanceFit.
class FittedResistance {
 public:
  /// Copies what it needs from `fit`, so that `fit` need not outlive the object.
  explicit FittedResistance(const ResistanceFit& fit);

  /// The radii of the spheres along the line [L], > 0.
  const std::vector<double>& radii() const { return radii_; }

  /// The smallest and the largest value of gap k [L] in the table.
  std::array<double, 2> gap_interval(std::size_t k) const { return intervals_.at(k); }

  /// True if each gap is within its interval, up to a relative 1e-12 for rounding.
  bool contains(std::span<const double> gaps) const;

  /// R at these gaps [L], one less than the spheres. Throws Error(kBadInput) unless contains(gaps).
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
