// What the errors of a fit do to the motion.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"

namespace viscontact {

/// A gap of the motion without inertia, with two intervals.
struct UncertainGap {
  double time = 0;  ///< [T]
  double gap = 0;   ///< of the fit as it is [L]
  /// Holds 95 % of the draws of coefficients [L].
  std::array<double, 2> random = {};
  /// Between the gaps if the drag were everywhere off by the same share, the misfit, up or down [L].
  std::array<double, 2> misfit = {};
};

struct FitUncertainty {
  std::size_t draws = 0;  ///< of coefficients
  std::size_t refused =
      0;  ///< of these: a drag that is not positive, or that such a motion is impossible with
  double misfit =
      0;  ///< r + e + r e of the largest relative residual r (of no outlier) and the table's largest error estimate e; at most 1
  UncertainGap smallest;           ///< q_min
  std::vector<UncertainGap> gaps;  ///< over time
};

inline constexpr std::size_t kDraws = 10000;

/// Propagates a fit to the inertialess motion Gamma(q(t)) = Gamma(q0) + int f_ext (reference_exact):
///   random  coefficients drawn from the normal distribution with the fit's covariance, which takes the misfit for independent noise;
///   misfit  as |R_fit/R - 1| <= misfit, Gamma_fit(q(t)) lies between Gamma_fit(q0) + (1 -+ misfit) int f_ext: a bound that no shape of the
///           misfit breaks, as far as it is known at the table's gaps.
/// Outside the fit's interval the limits of LubricationForce stand in: those given, kLubricationLimit and kStokesLimit in place of kError. q_min is sought at the starts and ends of the force's pieces.
/// `times`: how many instants from 0 to motion.end_time besides (0: q_min alone). The same numbers at each call.
/// Throws Error as LubricationForce for the fit itself, Error(kNotConverged) if every draw is refused.
FitUncertainty propagate_fit(const Motion& motion, const Fit& fit, std::size_t times,
                             BelowInterval below = BelowInterval::kError,
                             AboveInterval above = AboveInterval::kError,
                             std::size_t draws = kDraws);

/// The text of DIR/uncertainty.json.
std::string write_uncertainty(const FitUncertainty& uncertainty);

/// Throws Error(kBadInput) for another file.
FitUncertainty read_uncertainty(const std::filesystem::path& path);

}  // namespace viscontact
