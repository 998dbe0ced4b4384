// The sphere with its inertia, by CVODE.
#pragma once

#include "fitting/lubrication_force.hpp"
#include "reduced_model/motion.hpp"
#include "reduced_model/trajectory.hpp"

namespace viscontact {

/// Problem (M), m d^2q/dt^2 = -R(q) dq/dt + f_ext(t), in the variables s = ln q and w = ds/dt =
/// u/q:
///
///     ds/dt = w,    dw/dt = f/(m q) - R(q) w/m - w^2,    q = e^s, u = q w.
///
/// In q the problem is stiff without limit near contact and any error can push q below 0; in s
/// there is no contact to hit, and w stays of order f/k however thin the film. Each step is
/// projected onto the first integral (I),
///
///     m u + Gamma(q) = P(t) := m v0 + Gamma(q0) + int_0^t f_ext.
///
/// f_ext is constant between its jumps: CVODE stops at each and restarts. Rows: every
/// motion.reference_time_step, the jumps, and the instants where u = 0 (extrema of q). Throws
/// Error(kNotConverged) if CVODE gives up, Error(kBadInput) when the motion leaves the fit's
/// interval.
Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
