// Coulomb's friction of the solids of a contact with or without a film, docs/physics.md (5.7),
// (5.9) and (5.17).
#pragma once

namespace viscontact::particles {

enum class FrictionMethod {
  kCoulomb,  ///< Coulomb's law itself; the gap of a sliding contact stays closed
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
  FrictionMethod method = FrictionMethod::kCoulomb;
};

}  // namespace viscontact::particles
