// The models without inertia: `reference`, Lefebvre's reference solution (2008), physics.md (4.3),
// and `reference_exact` by the first integral (4.2).
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// The drag balances the external force at each instant (Lefebvre 2008, "Couplage F_lub"), for the
/// gap q, the velocity u and the resistance R:
///
///     F_lub(q^n, u^n) + f^n = 0,   that is u^n = f^n / R(q^n),
///     q^{n+1} = q^n + h u^n,
///
/// where f^n is the mean of the external force over step n and h = reference.time_step. The scheme
/// is of first order in h. Under a push to the wall the computed film is thinner than the exact
/// one. Throws Error(kNotConverged) if a step goes through the wall or R(q) is too large for a
/// double, Error(kBadInput) if the gap leaves the interval of `force`, or if the time step has no
/// value or makes more than 1e8 steps, and Error(kInterrupted) at a stop.
Trajectory simulate_reference(const Motion& motion, const lubrication::LubricationForce& force);

/// Without inertia, R(q) dq/dt = f_ext integrates to
///
///     Gamma(q(t)) = Gamma(q0) + int_0^t f_ext,
///
/// which is solved for q at the times of row_times(). Throws Error(kBadInput) if the gap leaves the
/// interval of `force`, Error(kNotConverged) if it gets too small for a double, the errors of
/// row_times(), and Error(kInterrupted) at a stop.
Trajectory simulate_reference_exact(const Motion& motion,
                                    const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
