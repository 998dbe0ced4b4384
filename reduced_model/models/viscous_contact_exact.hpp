// Viscous contact without a time step: from event to event.
#pragma once

#include "viscontact/reduced_model/models/contact_model.hpp"

namespace viscontact {

/// Problem (P) of viscous_contact.hpp, solved: with S(t) = int int f_ext and I(t) = int f_ext,
///
///     free:        q = q_0 + u_0 t + (S - S_0 - t I_0)/m,  u = u_0 + (I - I_0)/m,   until q = 0 while falling: gamma = m u-, u = 0;
///     in contact:  q = u = 0,  gamma = max(gamma_0 + I - I_0, gamma_min) while pushed,   until gamma = 0 while pulled.
///
/// Between two changes of sign of f_ext velocity and gamma are monotone and q has at most one turn, so no event is missed; times are found
/// by bisection, to round-off. (A force that changes sign twice within a 32nd of a piece or period is not seen to:
/// ExternalForce::sign_changes.) Rows: every motion.contact_time_step, the force's jumps, and the events; at an event, the state after it.
/// Throws Error(kBadInput) if the fit's resistance has no positive coefficient k of 1/q.
Trajectory simulate_viscous_contact_exact(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
