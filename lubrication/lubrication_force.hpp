// The lubrication force on a sphere, F_lub(q, u) = -R(q) u, and the primitive Gamma of its
// resistance R (docs/physics.md (2.3), (2.4), (3.2), (4.2)).
#pragma once

#include <array>
#include <limits>
#include <string>
#include <vector>

#include "viscontact/lubrication/fit.hpp"
#include "viscontact/lubrication/terms.hpp"

namespace viscontact::lubrication {

/// What the force is at gaps below the fitted interval [q1, q2].
enum class BelowInterval {
  /// Not known: functions of such a gap throw Error(kBadInput).
  kError,
  /// R(q) = R(q1) + k (1/q - 1/q1), with the fitted coefficient k of 1/q. In theory R - k/q varies
  /// only as ln q; this limit takes it as constant. Without a k > 0 it is kError.
  kLubricationLimit,
  /// R(q) = R(q1) + k (1/q - 1/q1), with the coefficient k > 0 of theory
  /// (Fit::leading_coefficient).
  kTheoryLimit
};

/// What the force is at gaps above the fitted interval [q1, q2].
enum class AboveInterval {
  /// Not known: functions of such a gap throw Error(kBadInput).
  kError,
  /// R(q) = R_S (1 + c/(q + r)), with Stokes' resistance R_S = 6 pi mu r for the viscosity mu and
  /// the radius r of the sphere, and with the c for which R is continuous at q2. So R approaches
  /// R_S as it does far from a plane (Happel & Brenner 1983, section 7-4: R_S (1 + (9/8) r/h) at
  /// the distance h of the centre). Far from a second sphere at rest R - R_S falls faster, as
  /// 1/h^2. If there is a second wall at the gap L (second_wall.hpp), the summand k_L (1/(L - q) -
  /// 1/(L - q2)) is added, with k_L of lubrication theory, so that R tends to infinity there. The
  /// wall around the axis of a container is neglected.
  kStokesLimit
};

struct OutsideInterval {
  BelowInterval below = BelowInterval::kError;  ///< at gaps in (0, q1)
  AboveInterval above = AboveInterval::kError;  ///< at gaps > q2

  /// A copy that throws no error for a gap > 0 below a second wall: `below` is kLubricationLimit if
  /// it was kError, and `above` is kStokesLimit.
  OutsideInterval with_limits() const;
};

/// The force of one fit at every velocity u [L/T], in any consistent units. Stokes flow is linear
/// in the velocity, so a fit at u0 gives F_lub(q, u) = (u/u0) F_lub(q, u0). R and Gamma are
/// continuous at the ends of the interval.
///
/// Every function of the gap throws Error(kBadInput), which names the interval, if the gap is
/// outside it or NaN, unless `outside` or the comment of the function allows that gap.
class LubricationForce {
 public:
  /// Throws Error(kBadInput) if the fit's resistance is not positive and finite at one of the 201
  /// gaps of spread_gaps() on its interval, if a term has an unknown name or needs a second wall
  /// that the fit does not name, or if `outside` asks for theory's k and the fit states none > 0. A
  /// fit whose basis is kExactPlane gives exact_plane(), for which `outside` has no effect.
  explicit LubricationForce(const Fit& fit, const OutsideInterval& outside = {});

  /// The exact drag of a sphere near a no-slip plane in a half-space (plane_drag.hpp), for gaps
  /// from 1e-300 to 1e300 radii. A smaller gap >= 0 throws Error(kNotConverged), a gap < 0 or a
  /// larger one Error(kBadInput). `viscosity` [M/(L T)] and `radius` [L] must be > 0.
  static LubricationForce exact_plane(double viscosity, double radius);

  /// The same drag up to the gap `largest_gap` [L], at which the sphere touches a neglected wall.
  LubricationForce below_wall(double largest_gap) const;

  /// The gap L [L] at which the sphere touches the wall opposite its neighbour (second_wall.hpp);
  /// infinity without such a wall. A gap >= L throws Error(kBadInput) everywhere.
  double largest_gap() const { return largest_gap_; }

  /// R(q) = -F_lub(q, u)/u [M/T], > 0. Throws Error(kNotConverged) if R is larger than the largest
  /// double, which can happen below the interval.
  double resistance(double gap) const;

  /// dR/d ln q = q dR/dq [M/T].
  double resistance_log_slope(double gap) const;

  /// R(q) - k/q [M/T], with the fitted k (0 without a term 1/q), for q >= 0. Below the interval it
  /// is constant, the value at the smallest fitted gap, whatever `outside` says.
  double regular_resistance(double gap) const;

  /// int_0^q (R(s) - k/s) ds [M L/T] for q >= 0, with R(s) - k/s by regular_resistance().
  double regular_impulse(double gap) const;

  /// Gamma(q) = int_r^q R(s) ds [M L/T], where r is the sphere's radius, or zero_of_impulse() of a
  /// fit. It is computed from a closed form and increases with q.
  double impulse(double gap) const;

  /// The gap q [L] with Gamma(q) = impulse [M L/T], to round-off, or the largest double below
  /// largest_gap() if q is nearer to it. Throws Error(kBadInput) if the gap is outside interval()
  /// or `impulse` is not finite, and Error(kNotConverged) if the gap is too small for a double. The
  /// search begins at the gap `near` > 0 [L], if finite.
  double gap_of_impulse(double impulse,
                        double near = std::numeric_limits<double>::infinity()) const;

  /// k [M L/T]: the coefficient of 1/q in R; for a plane 6 pi mu r^2 in theory. Throws
  /// Error(kBadInput) if the fit has no term 1/q or if k is not positive.
  double leading_coefficient() const;

  /// The smallest and the largest gap [L] at which the force is known. The first is 0 if
  /// OutsideInterval::below is not kError, and the second is largest_gap() if `above` is not
  /// kError; the gaps 0 and largest_gap() themselves are not accepted.
  std::array<double, 2> interval() const;

  double radius() const { return radius_; }        ///< r [L], > 0
  double viscosity() const { return viscosity_; }  ///< mu [M/(L T)], > 0

 private:
  /// R(q) = k/q + constant below the interval; k [M L/T], constant [M/T].
  struct LubricationLimit {
    double k, constant;
  };
  // The exact drag.
  LubricationForce(double viscosity, double radius);
  // Throws Error(kBadInput) if R is not known at the gap, and Error(kNotConverged) for the exact
  // drag if the gap is too small for a double.
  void check_gap(double gap) const;
  /// What a message recommends for a gap above the fitted interval.
  std::string remedy_above() const;
  /// The largest double below largest_gap() [L].
  double widest() const;
  // Sets the constants of the formulas outside the interval such that R is continuous.
  void set_limits(const Fit& fit);
  /// The constants below the interval. Throws Error(kBadInput) if the fit has no k > 0.
  LubricationLimit limit() const;
  /// ln(q/r) of two gaps between which Gamma(q) = impulse. Throws the errors of gap_of_impulse().
  std::array<double, 2> bracket_of_impulse(double impulse) const;

  // True for the exact drag, which uses none of the members from the fit.
  bool exact_ = false;
  // Weights of all_terms() in R: coefficient/-u0.
  std::vector<double> weights_;
  // weights_ with 0 for the term 1/q.
  std::vector<double> regular_weights_;
  double radius_, viscosity_;
  double leading_ = 0;  // k [M L/T]
  std::array<double, 2> fitted_interval_;
  OutsideInterval outside_;
  LubricationLimit limit_ = {};
  double image_ = 0;              // c [L] of AboveInterval::kStokesLimit
  double largest_gap_ = kNoWall;  // L [L] of a second wall
  double wall_leading_ = 0;       // k_L [M L/T] near the second wall
  // The sum of weight * antiderivative at zero_of_impulse() [M L/T], which is subtracted.
  double impulse_offset_ = 0;
  std::array<double, 2> impulses_at_ends_{};  // of fitted_interval_
};

}  // namespace viscontact::lubrication
