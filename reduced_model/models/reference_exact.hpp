// The reference solution without a time step: by the first integral.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// Without inertia, R(q) dq/dt = f_ext integrates to
///
///     Gamma(q(t)) = Gamma(q0) + int_0^t f_ext              (first integral (I) with m = 0),
///
/// solved for q at each row's time: every motion.reference_time_step, and where f_ext jumps.
/// u = f_ext / R(q). Throws Error(kBadInput) when the motion leaves the fit's interval.
Trajectory simulate_reference_exact(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
