// Declares the models without inertia: `reference`, the reference solution of Lefebvre's lecture
// (2008) by explicit Euler (physics.md (4.3)), and `reference_exact`, the solution without a time
// step by the first integral (4.2). q is the gap, q0 the initial gap, u the velocity, F_lub the
// lubrication force, R the resistance, Gamma the primitive of R, f_ext the external force. Lengths,
// masses and times are in any consistent units. models.cpp lists the models. Both models throw
// Error(kBadInput) if the motion has no value of reference.time_step; other members of the motion
// are not checked. A change of results must raise kModelsRevision (trajectory.hpp).
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// The drag balances the external force at each instant (Lefebvre 2008, "Couplage F_lub"):
///
///     F_lub(q^n, u^n) + f^n = 0,   that is u^n = f^n / R(q^n),
///     q^{n+1} = q^n + h u^n,
///
/// where f^n is the mean of the external force over step n and h = reference.time_step. The scheme
/// is of first order in h. There is a row for the start and for each step. Under a push to the wall
/// the computed film is thinner than the exact one. Throws Error(kNotConverged) if a step goes
/// through the wall or R(q) is too large for a double, Error(kBadInput) if the gap goes below or
/// above the interval of `force` or if there are more than 1e8 steps, and Error(kInterrupted) if
/// `motion.stop` requests a stop.
Trajectory simulate_reference(const Motion& motion, const lubrication::LubricationForce& force);

/// Without inertia, R(q) dq/dt = f_ext integrates to
///
///     Gamma(q(t)) = Gamma(q0) + int_0^t f_ext,
///
/// which is solved for q at the time of each row: the multiples of reference.time_step, and the
/// jumps of f_ext. The velocity is u = f_ext/R(q). Throws Error(kBadInput) if the gap goes below or
/// above the interval of `force` or if there are more than 1e8 of these multiples,
/// Error(kNotConverged) if the gap gets too small for a double, and Error(kInterrupted) if
/// `motion.stop` requests a stop.
Trajectory simulate_reference_exact(const Motion& motion,
                                    const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
