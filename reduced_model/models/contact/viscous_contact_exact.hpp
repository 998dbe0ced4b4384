// The model `viscous_contact_exact`: viscous contact without a time step, from event to event,
// physics.md (4.4), (4.6), (4.12).
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// The exact solution of problem (P) of viscous_contact.hpp. m is the mass, I(t) the integral of
/// f_ext from 0 to t, S(t) the integral of I; index 0 marks values at the last event (landing,
/// release, or touch of the solids):
///
///     free:        q = q_0 + (t - t_0) u_0 + (S - S_0 - (t - t_0) I_0)/m,  u = u_0 + (I - I_0)/m,
///                  until q = 0 in a fall; then the impact of rebound.hpp gives u and gamma,
///     in contact:  q = u = 0,  gamma = max(gamma_0 + I - I_0, gamma_min),
///                  until gamma = 0 under a pull.
///
/// Between two changes of sign of f_ext, velocity and gamma are monotone and q has at most one
/// extremum, so that no event is missed. If a force with sinusoids changes its sign twice within
/// 1/32 of a period, both changes can be missed. The rows are those of row_times() with
/// viscous_contact.time_step, and the events, where a row has the state after the event. Throws the
/// errors of viscous_contact(), row_times() and ExternalForce::sign_changes(), and
/// Error(kInterrupted) at a stop.
Trajectory simulate_viscous_contact_exact(const Motion& motion,
                                          const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
