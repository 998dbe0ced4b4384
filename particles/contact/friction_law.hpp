// Coulomb's friction of the solids of a contact with or without a film, docs/physics.md (5.7),
// (5.9) and (5.17).
#pragma once

#include <algorithm>
#include <cassert>

namespace viscontact::particles {

enum class FrictionMethod {
  kFixedPoint,  ///< Coulomb's law itself; the gap of a sliding contact stays closed
  /// A convex problem. A contact without a film that slides at v_t opens by h mu_s |v_t| in a step
  /// of length h, (5.9). A contact with a film stays closed, and mu_s times the load of its solids
  /// in the previous solution bounds its friction, (5.17).
  kConvex,
};

/// The friction p_t in a step is at most mu_s times p_s, the part of the normal impulse p_n that
/// the solids carry. The film carries the first part of p_n, up to gamma^n - gamma_min, and no
/// friction. Here gamma <= 0 is minus the impulse that the film has absorbed, gamma^n is its value
/// before the step, and gamma_min its value when the solids touch:
///
///     p_s = max(p_n - (gamma^n - gamma_min), 0),   |p_t| <= mu_s p_s,
///     p_t = -mu_s p_s v_t/|v_t| if the surfaces slip with the velocity v_t.
struct FrictionLaw {
  double coefficient = 0;  ///< mu_s [1], >= 0
  FrictionMethod method = FrictionMethod::kFixedPoint;

  /// p_s [M L/T] for a film that can take up `capacity` = gamma^n - gamma_min >= 0, which may be
  /// infinite.
  static double carried(double p_n, double capacity) { return std::max(p_n - capacity, 0.0); }
};

/// A point of the cone |p_t| <= mu_s p_s of the impulses that (5.9) allows.
struct FrictionCone {
  /// kInside: the given impulses are in the cone. Otherwise the point is the apex, where all
  /// impulses are 0, or another point of the surface.
  enum class Part { kApex, kInside, kSurface };
  Part part = Part::kApex;
  double load = 0;        ///< p_s of the point [M L/T]
  double tangential = 1;  ///< p_t of the point over the given p_t [1], 0 to 1

  /// The point that is nearest to p_s [M L/T], of any sign, and |p_t| = `length` [M L/T] in the
  /// norm sqrt(w_n p_s^2 + w_t |p_t|^2). The weights are the mobilities of the contact [T/M] along
  /// its normal and its tangents; only their ratio matters.
  static FrictionCone nearest(double mu_s, double p_s, double length, double w_n, double w_t) {
    assert(mu_s >= 0);
    if (length <= mu_s * p_s) return {Part::kInside, p_s, 1};
    const double load = (w_n * p_s + w_t * mu_s * length) / (w_n + w_t * mu_s * mu_s);
    if (!(load > 0)) return {Part::kApex, 0, 0};
    return {Part::kSurface, load, mu_s * load / length};
  }
};

}  // namespace viscontact::particles
