// How the errors of a fit of the drag change the gap in a motion without inertia, physics.md (4.2)
// with mass 0. q is the gap, R the resistance, Gamma the primitive of R, f_ext the external force.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact::reduced_model {

/// A gap of the motion without inertia at one time, with two intervals for it.
struct UncertainGap {
  double time = 0;  ///< [T], >= 0
  double gap = 0;   ///< gap with the coefficients of the fit [L], > 0
  /// Ends, in increasing order, of the interval that contains 95 % of the draws [L].
  std::array<double, 2> random = {};
  /// The gaps if the drag is everywhere as large, or as small, as the misfit allows, increasing
  /// [L].
  std::array<double, 2> misfit = {};
};

/// What a fit with errors says of a motion.
struct FitUncertainty {
  std::size_t draws = 0;  ///< all draws of coefficients, also those left out
  /// Draws that were left out, because the motion is impossible with their drag.
  std::size_t refused = 0;
  /// Bound of the relative error of the drag, at most 1: (1 + r)(1 + e) - 1, with the largest
  /// relative residual r of the fit (without outliers) and the largest error estimate e of the
  /// table.
  double misfit = 0;
  UncertainGap smallest;           ///< the smallest gap of the motion, q_min
  std::vector<UncertainGap> gaps;  ///< at equidistant, increasing times; may be empty
};

/// With this number of draws the ends of the interval of 95 % have an error of about 1 % of its
/// width. The computing time is proportional to it.
inline constexpr std::size_t kDraws = 10000;

/// Propagates the errors of a fit to the motion without inertia, Gamma(q(t)) = Gamma(q0) + int
/// f_ext (model reference_exact), in two ways (R_fit and Gamma_fit are those of the fit, R the true
/// resistance):
///   random  draws coefficients from the normal distribution with the covariance of the fit, which
///           treats the residuals of the fit as independent noise;
///   misfit  uses |R_fit/R - 1| <= misfit, so that Gamma_fit(q(t)) is between Gamma_fit(q0) +
///           (1 - misfit) int f_ext and Gamma_fit(q0) + (1 + misfit) int f_ext. This bound is valid
///           for every shape of the misfit, as far as the misfit is known at the gaps of the table.
///
/// Outside the fit's interval the drag follows outside.with_limits(). The smallest gap, q_min,
/// occurs at the time 0, at a time at which f_ext changes its sign, or at the end. If f_ext has too
/// many periods for ExternalForce::sign_changes(), only 0, jumps of f_ext and the end are looked
/// at. `times` is the number of further, equidistant instants from 0 to motion.end_time: 0 asks for
/// q_min alone, and 1 also for the start. Equal arguments give equal numbers. Throws the Errors of
/// LubricationForce if it refuses the fit itself or cannot compute a gap with it, and
/// Error(kNotConverged) if all draws were left out or `draws` is 0.
FitUncertainty propagate_fit(const Motion& motion, const lubrication::Fit& fit, std::size_t times,
                             const lubrication::OutsideInterval& outside = {},
                             std::size_t draws = kDraws);

/// The text of the file uncertainty.json (docs/file-formats.md).
std::string write_uncertainty(const FitUncertainty& uncertainty);

/// Throws Error(kBadInput) if the file uncertainty.json is missing or of another form.
FitUncertainty read_uncertainty(const std::filesystem::path& path);

}  // namespace viscontact::reduced_model
