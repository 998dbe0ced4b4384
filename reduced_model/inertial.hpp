// The sphere with its inertia, by CVODE.
#pragma once

#include "fitting/lubrication_force.hpp"
#include "reduced_model/motion.hpp"
#include "reduced_model/trajectory.hpp"

namespace viscontact {

/// Problem (M), m d^2q/dt^2 = -R(q) dq/dt + f_ext(t), in the variables s = ln q, w = ds/dt = u/q:
///
///     ds/dt = w,    dw/dt = f/(m q) - R(q) w/m - w^2,    q = e^s, u = q w.
///
/// It is as stiff as in q (the film damps at the rate R/m), but no error can push q below 0, and w stays of
/// order f/k however thin the film. Each step is projected onto the first integral (I),
///
///     m u + Gamma(q) = P(t) := m v0 + Gamma(q0) + int_0^t f_ext.
///
/// so (I) holds by construction, to the tolerance of the projection: it is no check of this model. (Those are
/// the exact states of data/reference/limit_case_states.csv.)
///
/// f_ext is constant between its jumps: CVODE stops at each and restarts. Where the film damps within less than
/// 1e-12 of the time of a jump, which no step can resolve, w is set to its balance f/(R q) there; (I) is off by
/// m times the change of u, at most. Rows: every motion.reference_time_step, the jumps, and the instants where
/// u = 0 (extrema of q). motion.inertial_relative_tolerance bounds the errors of ln q (absolute and relative)
/// and of w in each step, with a tenth of it to spare for their sum.
/// Throws Error(kNotConverged) if CVODE gives up, Error(kBadInput) when the motion leaves the fit's interval.
Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
