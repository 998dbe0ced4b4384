// Coulomb's friction of solids that touch through a film, docs/physics.md (5.7), (5.9) and (5.17).
// Lengths, masses and times are in any consistent units. constraints/ and impacts/ solve it.
// Nothing is checked or thrown. A change must keep that the film carries no friction.
#pragma once

#include <algorithm>

namespace viscontact::particles {

/// How the law is solved in a step.
enum class FrictionMethod {
  kFixedPoint,  ///< Coulomb's law; sliding contacts stay closed
  /// Convex problems. With the relaxation (5.9) a dry contact that slides at the velocity v_t opens
  /// by h mu_s |v_t| in a step of length h. A contact with a film stays closed, and its friction
  /// has the bound of the load that its solids had in the solution before, (5.17).
  kConvex,
};

/// Coulomb's friction of all contacts. It is bounded by the part p_s of the normal impulse p_n that
/// the solids carry, because the part that the film carries causes no friction. p_t is the impulse
/// of friction, and gamma^n and gamma_min are those of film_law.hpp:
///
///     p_s = max(p_n - (gamma^n - gamma_min), 0),   |p_t| <= mu_s p_s,
///     p_t = -mu_s p_s v_t/|v_t| if the surfaces slip with the velocity v_t.
struct FrictionLaw {
  double coefficient = 0;                               ///< mu_s, >= 0
  FrictionMethod method = FrictionMethod::kFixedPoint;  ///< how a step is solved

  /// p_s >= 0 [M L/T] of the normal impulse `p_n` on a film that can take up `capacity` = gamma^n -
  /// gamma_min >= 0 [M L/T].
  static double carried(double p_n, double capacity) { return std::max(p_n - capacity, 0.0); }
};

/// A point of the cone |p_t| <= mu_s p_s, the set of allowed impulses in (5.9).
struct FrictionCone {
  /// Where the point is.
  enum class Part { kApex, kInside, kSurface };
  Part part = Part::kApex;  ///< where the point is
  double load = 0;          ///< p_s >= 0 [M L/T]
  double tangential = 1;    ///< factor by which p_t was shortened

  /// Point of the cone nearest to impulses with the load `p_s` and |p_t| = `length` in the norm
  /// w_n p_s^2 + w_t |p_t|^2. Here w_n and w_t are positive numbers whose ratio matters, such as
  /// mobilities of the rows.
  static FrictionCone nearest(double mu_s, double p_s, double length, double w_n, double w_t) {
    if (length <= mu_s * p_s) return {Part::kInside, p_s, 1};
    const double load = (w_n * p_s + w_t * mu_s * length) / (w_n + w_t * mu_s * mu_s);
    if (!(load > 0)) return {Part::kApex, 0, 0};
    return {Part::kSurface, load, mu_s * load / length};
  }
};

}  // namespace viscontact::particles
