// Declares the model `viscous_contact_exact`: viscous contact without a time step, from event to
// event (physics.md (4.4), (4.6)). q is the gap, u the velocity, m the mass and f_ext the external
// force; -gamma >= 0 is the impulse that the film of fluid has absorbed, and the solids touch at
// gamma = gamma_min. Lengths, masses and times are in any consistent units. models.cpp lists the
// model; studies and tests use it as the reference for the models with a time step.
// Error(kBadInput) is thrown if the fit has no positive coefficient of 1/q or a row spacing is
// wrong, Error(kInterrupted) at a stop. A change of results must raise kModelsRevision
// (trajectory.hpp).
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Computes the exact solution of viscous contact, problem (P) of viscous_contact.hpp, from 0 to
/// motion.end_time. I(t) is the integral of f_ext from 0 to t, S(t) the integral of I, and the
/// index 0 marks values at the last event (landing, release, or the instant at which the solids
/// touch):
///
///     free:        q = q_0 + (t - t_0) u_0 + (S - S_0 - (t - t_0) I_0)/m,  u = u_0 + (I - I_0)/m,
///                  until q = 0 in a fall; then the impact of rebound.hpp gives u and gamma,
///     in contact:  q = u = 0,  gamma = max(gamma_0 + I - I_0, gamma_min),
///                  until gamma = 0 under a pull.
///
/// Between two changes of sign of f_ext, velocity and gamma are monotone and q has at most one
/// extremum, so that no event is missed. The times of events are found by bisection, to round-off.
/// If a force with sinusoids changes its sign twice within 1/32 of a period, both changes can be
/// missed (ExternalForce::sign_changes()). The rows are at the multiples of
/// viscous_contact.time_step, which only sets their spacing, at the jumps of the force, and at the
/// events, where a row has the state after the event. Throws Error(kBadInput) if the fit's
/// resistance has no positive coefficient k of 1/q, if viscous_contact.time_step has no value or if
/// there would be more than 1e8 of its multiples, Error(kNotConverged) if f_ext has too many
/// periods (sign_changes()), and Error(kInterrupted) if `motion.stop` requests a stop.
Trajectory simulate_viscous_contact_exact(const Motion& motion,
                                          const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
