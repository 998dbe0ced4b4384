// The model `reference_exact`: the solution without inertia and without a time step, by the first
// integral (physics.md (4.2)). q is the gap, q0 the initial one, R the resistance, Gamma its
// primitive, f_ext the external force. Lengths, masses and times are in any consistent units.
// models.cpp lists the model. A change of results must raise kModelsRevision.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// Without inertia, R(q) dq/dt = f_ext integrates to
///
///     Gamma(q(t)) = Gamma(q0) + int_0^t f_ext              (the first integral without mass),
///
/// which is solved for q at the time of each row: the multiples of reference.time_step, and
/// the jumps of f_ext. The velocity is u = f_ext/R(q). Throws Error(kBadInput) if the motion leaves
/// the fit's interval.
Trajectory simulate_reference_exact(const Motion& motion,
                                    const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
