// Computes how the errors of a fit of the drag change the motion of the sphere without inertia
// (physics.md (4.2) with mass 0), for uncertainty.json and the report. q is the gap, q0 the initial
// gap, R the resistance, Gamma the primitive of R, f_ext the external force; the index `fit` marks
// R and Gamma of the fit, as opposed to the true ones. Lengths, masses and times are in the units
// of the case. Error(kBadInput) or Error(kNotConverged) is thrown if the drag of the fit cannot be
// computed. If this happens for a random draw of coefficients, the draw is left out and counted.
// pipeline/simulate, results/ and report/ call these functions. A change must keep the draws equal
// for equal arguments.
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
  double time = 0;  ///< time [T], >= 0
  double gap = 0;   ///< gap with the coefficients of the fit [L], > 0
  /// Ends, in increasing order, of the interval that contains 95 % of the draws [L].
  std::array<double, 2> random = {};
  /// The gaps if the drag is everywhere as large, or as small, as the misfit allows, in increasing
  /// order [L].
  std::array<double, 2> misfit = {};
};

/// The uncertain gaps of a motion.
struct FitUncertainty {
  std::size_t draws = 0;  ///< number of all draws of coefficients, also of those left out
  /// Number of draws that were left out, because their drag is not positive or the motion is
  /// impossible with it.
  std::size_t refused = 0;
  /// Bound of the relative error of the drag [1], at most 1: (1 + r)(1 + e) - 1, with the largest
  /// relative residual r of the fit (without the rows that it lists as outliers) and the largest
  /// error estimate e of the table.
  double misfit = 0;
  UncertainGap smallest;           ///< smallest gap of the motion, q_min
  std::vector<UncertainGap> gaps;  ///< at equidistant, increasing times; may be empty
};

/// Default number of draws, a free choice. With it the ends of the interval of 95 % have an error
/// of about 1 % of the width of the interval. Computing time is proportional to this number.
inline constexpr std::size_t kDraws = 10000;

/// Propagates the errors of a fit to the motion without inertia, Gamma(q(t)) = Gamma(q0) + int
/// f_ext (model reference_exact), in two ways:
///   random  draws coefficients from the normal distribution with the covariance of the fit, which
///           treats the residuals of the fit as independent noise;
///   misfit  uses |R_fit/R - 1| <= misfit, so that Gamma_fit(q(t)) is between Gamma_fit(q0) +
///           (1 - misfit) int f_ext and Gamma_fit(q0) + (1 + misfit) int f_ext. This bound is valid
///           for every shape of the misfit, as far as the misfit is known at the gaps of the table.
///
/// Outside the fit's interval the drag follows outside.with_limits(), so that no gap is refused
/// there if the fit has a coefficient k > 0 of 1/q. The smallest gap, q_min, occurs at the time 0,
/// at a time at which f_ext changes its sign, or at the end. If f_ext has too many periods for
/// ExternalForce::sign_changes(), only 0, jumps of f_ext and the end are looked at. `times` is the
/// number of further, equidistant instants from 0 to motion.end_time: 0 asks for q_min alone, and 1
/// also for the start. fit.covariance must have a row and a column for each term (not checked).
/// Equal arguments give equal numbers. Throws the Errors of LubricationForce (kBadInput or
/// kNotConverged) if it refuses the fit itself or cannot compute a gap with it, and
/// Error(kNotConverged) if all draws were left out or `draws` is 0.
FitUncertainty propagate_fit(const Motion& motion, const lubrication::Fit& fit, std::size_t times,
                             const lubrication::OutsideInterval& outside = {},
                             std::size_t draws = kDraws);

/// The text of the file uncertainty.json (JSON). Nothing is thrown.
std::string write_uncertainty(const FitUncertainty& uncertainty);

/// Reads a file uncertainty.json. Throws Error(kBadInput) if the file is missing or of another
/// form.
FitUncertainty read_uncertainty(const std::filesystem::path& path);

}  // namespace viscontact::reduced_model
