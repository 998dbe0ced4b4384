// The sphere with its inertia, by CVODE.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// Integrates problem (M) with CVODE, in the form (S) of inertial_equation.hpp.
///
/// The equation is stiff, because the film damps at the rate R/m, but errors of s die out in the film
/// and do not add up. (I) holds by construction and is no check of this model; its checks are exact
/// states (data/reference/limit_case_states.csv) and an integration of (M) in extended precision.
///
/// CVODE stops where f_ext or its slope jumps, and restarts. Rows: every motion.reference_time_step,
/// the jumps, and the instants at which u = 0 (extrema of q). The error of s is at most a tenth of
/// motion.inertial_relative_tolerance in a step, and 3e-4 of that in flight. A fall that a film stops
/// within 1e-12 of t, which no step can resolve, ends in that film at once.
///
/// Throws Error(kNotConverged) if CVODE gives up; Error(kBadInput) if the motion leaves the interval of
/// the fit.
Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
