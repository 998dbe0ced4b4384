// The lubrication force, fitted or exact, as a function: F_lub(q, u) = -R(q) u, its resistance R, and Gamma,
// the impulse that the film has absorbed.
#pragma once

#include <array>
#include <vector>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact {

/// What the force is at gaps below the fitted interval [q1, q2].
enum class BelowInterval {
  kError,             ///< nothing: asking is an error
  kLubricationLimit,  ///< R(q1) + k (1/q - 1/q1), k the fit's coefficient of 1/q: what theory adds to k/q varies as ln q only
  kTheoryLimit        ///< the same, k as theory has it (Fit::leading_coefficient)
};

/// What the force is at gaps above it.
enum class AboveInterval {
  kError,       ///< nothing: asking is an error
  kStokesLimit  ///< Stokes' drag in the end: R_S (1 + c/(q + r)), R_S = 6 pi mu r, c such that R is continuous at q2. The first
  ///< reflection at a wall decays so (Happel & Brenner 1983, section 7-4: 1 + (9/8) r/h for a plane); that of a second sphere
  ///< at rest decays faster, as 1/h^2; a container's other walls have no part in it
};

/// Stokes flow is linear, so a fit at u0 gives the force at every velocity: F_lub(q, u) = (u / u0) F_lub(q, u0).
/// Every function of the gap throws Error(kBadInput) that names the interval for a gap outside the fit's, unless
/// `below`, `above` or the function's own words allow it.
class LubricationForce {
 public:
  /// Throws Error(kBadInput) if the fit's resistance is not positive at one of 201 gaps spread over its interval.
  /// Error(kBadInput) too if `below` asks for theory's k and the fit has none.
  /// A fit of basis kExactPlane makes exact_plane().
  explicit LubricationForce(const Fit& fit, BelowInterval below = BelowInterval::kError,
                            AboveInterval above = AboveInterval::kError);

  /// The exact drag of a sphere near a no-slip plane in a half-space (plane_drag.hpp), for every gap > 0.
  static LubricationForce exact_plane(double viscosity, double radius);

  /// R(q) = -F_lub(q, u)/u [M/T], > 0. Throws Error(kNotConverged) below the interval if it is larger than a double can hold.
  double resistance(double gap) const;

  /// dR/d ln q = q dR/dq [M/T].
  double resistance_log_slope(double gap) const;

  /// R(q) - k/q [M/T], k the fit's, for 0 <= q: below the interval, its value at the smallest fitted gap.
  double regular_resistance(double gap) const;

  /// int_0^q (R(s) - k/s) ds [M L/T], for 0 <= q, with the same extension.
  double regular_impulse(double gap) const;

  /// Gamma(q) = int_r^q R(s) ds [M L/T], r the sphere's radius; closed form, increasing in q.
  double impulse(double gap) const;

  /// The gap q with Gamma(q) = impulse, to round-off.
  double gap_of_impulse(double impulse) const;

  /// k [M L/T]: coefficient of 1/q in R; 6 pi mu r^2 in theory for a plane. Throws Error(kBadInput)
  /// if the fit has none, or it is not positive.
  double leading_coefficient() const;

  /// The gaps [L] at which the functions above may be called; the first is 0 and the second infinite where the limits are asked for.
  std::array<double, 2> interval() const;

  double radius() const { return radius_; }        ///< r [L]
  double viscosity() const { return viscosity_; }  ///< mu [M/(L T)]

 private:
  /// R(q) = k/q + constant below the interval.
  struct LubricationLimit {
    double k, constant;
  };
  LubricationForce(double viscosity, double radius);
  void check_gap(double gap) const;
  void set_limits(const Fit& fit);
  /// Throws Error(kBadInput) if the fit has no k to go below its interval with.
  LubricationLimit limit() const;
  /// ln(q/r) of two gaps with Gamma(q) = impulse between them.
  std::array<double, 2> bracket_of_impulse(double impulse) const;

  bool exact_ = false;                   // Brenner's series; the fit's members are not used then
  std::vector<double> weights_;          // of all_terms() in R: coefficient / -u0
  std::vector<double> regular_weights_;  // the same without 1/q
  double radius_, viscosity_;
  double leading_ = 0;  // k
  std::array<double, 2> fitted_interval_;
  BelowInterval below_ = BelowInterval::kError;
  AboveInterval above_ = AboveInterval::kError;
  LubricationLimit limit_ = {};
  double image_ = 0;              // c [L] of the Stokes limit
  double impulse_at_radius_ = 0;  // of the bare antiderivatives
};

}  // namespace viscontact
