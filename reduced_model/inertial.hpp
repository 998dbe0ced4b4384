// The sphere with its inertia, by CVODE.
#pragma once

#include "fitting/lubrication_force.hpp"
#include "reduced_model/motion.hpp"
#include "reduced_model/trajectory.hpp"

namespace viscontact {

/// Problem (M), m d^2q/dt^2 = -R(q) dq/dt + f_ext(t), by way of its first integral (I), which is exact and leaves one equation of first order, in s = ln(q/r):
///
///     m u + Gamma(q) = P(t) := m v0 + Gamma(q0) + int_0^t f_ext,
///     ds/dt = (P(t) - Gamma(q))/(m q),    q = r e^s.
///
/// The radius r in s makes the error weights of CVODE, and so its steps, independent of the unit of
/// length.
/// It is stiff (the film damps at the rate R/m), but no error can push q below 0, an error of s dies out in the film instead of adding up, and P is continuous where f_ext jumps. As
/// (I) holds by construction it is no check of this model; those are exact states (data/reference/limit_case_states.csv) and an integration of (M) in extended precision.
///
/// The velocity of a row is (P - Gamma)/m, or, where that cancels (a film so thin that m/R is short beside all else), the balance with the drag and its first correction for inertia,
/// u = u_0 - (m/R) du_0/dt, u_0 = f/R, if the two agree to within the former's error.
///
/// A fall so fast that the film of thickness Gamma^{-1}(P) takes all of its momentum within 1e-12 of t, which no step can resolve, ends in that film at once.
///
/// CVODE stops where f_ext or its slope jumps, and restarts. Rows: every motion.reference_time_step, those times, and the instants where
/// u = 0 (extrema of q). A tenth of motion.inertial_relative_tolerance bounds the error of s in each step, which leaves room for their sum; where the film does not
/// damp errors (in flight) it is 3e-4 of that, as a landing multiplies them.
/// Throws Error(kNotConverged) if CVODE gives up, Error(kBadInput) when the motion leaves the fit's interval.
Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
