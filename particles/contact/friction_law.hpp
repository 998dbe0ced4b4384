// Coulomb's friction of the solids of a contact, whose surfaces may have a film between them,
// docs/physics.md (5.7), (5.9) and (5.17). Lengths [L], masses [M] and times [T] are in any
// consistent units. Nothing is checked or thrown. A case has its law of friction in
// contact_laws.hpp; constraints/, impacts/ and fluid/ solve it. A change must keep that the film
// carries no friction.
#pragma once

#include <algorithm>

namespace viscontact::particles {

/// How the law is solved in a step.
enum class FrictionMethod {
  kFixedPoint,  ///< Coulomb's law itself is solved; the gap of a sliding contact stays closed
  /// A convex problem in place of Coulomb's law. A contact without a film that slides at the
  /// velocity v_t opens by h mu_s |v_t| in a step of length h, (5.9), where mu_s is the coefficient
  /// of friction. A contact with a film stays closed, and its friction is bounded by mu_s times the
  /// load that its solids bore in the previous solution, (5.17).
  kConvex,
};

/// Coulomb's friction of all contacts. Its impulse p_t in a step is at most mu_s times p_s, the
/// part of the normal impulse p_n that the solids carry. The film carries the first part of p_n, up
/// to gamma^n - gamma_min. Here gamma <= 0 is minus the impulse that the film has absorbed, gamma^n
/// is its value before the step, and gamma_min its value when the solids touch:
///
///     p_s = max(p_n - (gamma^n - gamma_min), 0),   |p_t| <= mu_s p_s,
///     p_t = -mu_s p_s v_t/|v_t| if the surfaces slip with the velocity v_t.
struct FrictionLaw {
  double coefficient = 0;                               ///< mu_s [1], >= 0
  FrictionMethod method = FrictionMethod::kFixedPoint;  ///< how a step is solved

  /// p_s >= 0 [M L/T], for the normal impulse `p_n` [M L/T] of any sign, and a film that can take
  /// up `capacity` = gamma^n - gamma_min >= 0 [M L/T], which may be infinite.
  static double carried(double p_n, double capacity) { return std::max(p_n - capacity, 0.0); }
};

/// A point of the cone |p_t| <= mu_s p_s, the set of the impulses that (5.9) allows. It is the
/// result of nearest().
struct FrictionCone {
  /// kInside: the given impulses are in the cone, and are the point. Otherwise the point is the
  /// apex, where all impulses are 0 (kApex), or another point of the surface (kSurface).
  enum class Part { kApex, kInside, kSurface };
  Part part = Part::kApex;  ///< where the point is
  double load = 0;          ///< p_s of the point [M L/T], >= 0
  double tangential = 1;    ///< p_t of the point divided by the given p_t [1], 0 to 1

  /// The point of the cone that is nearest to the impulses p_s = `p_s` [M L/T], of any sign, and
  /// |p_t| = `length` [M L/T], >= 0, in the norm sqrt(w_n p_s^2 + w_t |p_t|^2). `mu_s` [1] is >= 0.
  /// The weights `w_n` and `w_t`, both > 0, are the mobilities of the contact [T/M] along its
  /// normal and its tangents; only their ratio matters.
  static FrictionCone nearest(double mu_s, double p_s, double length, double w_n, double w_t) {
    if (length <= mu_s * p_s) return {Part::kInside, p_s, 1};
    const double load = (w_n * p_s + w_t * mu_s * length) / (w_n + w_t * mu_s * mu_s);
    if (!(load > 0)) return {Part::kApex, 0, 0};
    return {Part::kSurface, load, mu_s * load / length};
  }
};

}  // namespace viscontact::particles
