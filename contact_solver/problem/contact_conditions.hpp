// The conditions of a contact: its gap and impulse, and the bound of friction by the load of the
// solids, docs/physics.md (5.4), (5.7) and (5.9).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>

namespace viscontact::contact_solver {

/// Residual [L] of the conditions gap >= 0, impulse >= lowest, and equality in one of the two.
/// `slack` is the mobility times (impulse - lowest) [L].
inline double contact_residual(double gap_after, double slack) {
  return std::abs(std::min(gap_after, slack));
}

/// The load of the solids [M L/T] at the normal impulse `p_n`, of which a film takes up to
/// `capacity` >= 0, which may be infinite.
inline double load_of_solids(double p_n, double capacity) { return std::max(p_n - capacity, 0.0); }

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

}  // namespace viscontact::contact_solver
