// The fitted lubrication force as a function: F_lub(q, u) = -R(q) u, its resistance R, and Gamma,
// the impulse that the film has absorbed.
#pragma once

#include <array>
#include <vector>

#include "fitting/fit.hpp"
#include "fitting/terms.hpp"

namespace viscontact {

/// What the force is at gaps below the fitted interval.
enum class BelowInterval {
  kError,             ///< nothing: asking is an error
  kLubricationLimit,  ///< k/q, plus R - k/q as it is at the smallest fitted gap (what theory adds
                      ///< to k/q varies as ln q only)
};

/// Stokes flow is linear, so a fit at u0 gives the force at every velocity: F_lub(q, u) = (u / u0) F_lub(q, u0).
/// Every function of the gap throws Error(kBadInput) that names the interval for a gap outside the fit's, unless
/// `below` or the function's own words allow it.
class LubricationForce {
 public:
  /// Throws Error(kBadInput) if the fit's resistance is not positive at one of 201 gaps spread over its interval.
  explicit LubricationForce(const Fit& fit, BelowInterval below = BelowInterval::kError);

  /// R(q) = -F_lub(q, u)/u [M/T], > 0.
  double resistance(double gap) const;

  /// dR/d ln q = q dR/dq [M/T].
  double resistance_log_slope(double gap) const;

  /// R(q) - k/q [M/T], for 0 <= q: below the interval, its value at the smallest fitted gap.
  double regular_resistance(double gap) const;

  /// Gamma(q) = int_r^q R(s) ds [M L/T], r the sphere's radius; closed form, increasing in q.
  double impulse(double gap) const;

  /// The gap q with Gamma(q) = impulse, to round-off.
  double gap_of_impulse(double impulse) const;

  /// k [M L/T]: coefficient of 1/q in R; 6 pi mu r^2 in theory for a plane. Throws Error(kBadInput)
  /// if the fit has none, or it is not positive.
  double leading_coefficient() const;

  /// The gaps [L] at which the functions above may be called; the first is 0 with
  /// BelowInterval::kLubricationLimit.
  std::array<double, 2> interval() const;

  double radius() const { return radius_; }        ///< r [L]
  double viscosity() const { return viscosity_; }  ///< mu [M/(L T)]

 private:
  struct WeightedTerm {
    Term term;
    double weight;  // coefficient / -u0
  };
  double sum(double (*Term::*function)(double), double gap) const;
  void check_gap(double gap) const;

  std::vector<WeightedTerm> terms_;
  double radius_, viscosity_;
  double leading_ = 0;  // k
  std::array<double, 2> fitted_interval_;
  BelowInterval below_;
  double impulse_at_radius_;  // of the bare antiderivatives
};

}  // namespace viscontact
