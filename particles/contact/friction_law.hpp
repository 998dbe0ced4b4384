// Coulomb's friction of solid contact, docs/physics.md (5.7).
#pragma once

namespace viscontact::particles {

/// How the law is solved in a step.
enum class FrictionMethod {
  kFixedPoint,  ///< Coulomb's law; sliding contacts stay closed
  /// The convex relaxation (5.9), in which a sliding contact opens by h mu_s |v_t| in a step.
  kConvex,
};

/// Coulomb's friction of all contacts.
struct FrictionLaw {
  double coefficient = 0;                               ///< mu_s, >= 0
  FrictionMethod method = FrictionMethod::kFixedPoint;  ///< how a step is solved
};

}  // namespace viscontact::particles
