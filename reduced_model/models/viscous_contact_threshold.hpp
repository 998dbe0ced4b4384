// Viscous contact at a distance, with the whole fitted drag beyond it.
#pragma once

#include "viscontact/reduced_model/models/contact_model.hpp"

namespace viscontact {

/// The lecture's splitting ("Methode de splitting") where the fluid solver resolves the film down
/// to q_c = motion.threshold_gap: the whole drag R(q) acts for q > q_c, and the sphere is in
/// contact at q_c, with Gamma in place of k ln q. The film is Gamma^{-1}(Gamma(q_c) + gamma) thick,
/// and gamma_min = Gamma(r1 + r2) - Gamma(q_c) (minus infinity if smooth).
/// The drag enters by its impulse (contact_step.hpp), so m u + Gamma(q) + gamma = P(t) in every step: the film of a sphere at rest is exact,
/// whatever the step. `force` must outlive the model. Throws Error(kBadInput) unless r1 + r2 < q_c < the initial
/// gap, or when q_c or the roughness is outside the fit's interval.
ContactModel viscous_contact_threshold(const Motion& motion, const LubricationForce& force);

/// Runs it (run_contact_model).
Trajectory simulate_viscous_contact_threshold(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
