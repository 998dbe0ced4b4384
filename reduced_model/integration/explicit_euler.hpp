// What a careless integrator makes of the sphere with its inertia.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// Problem (M) by explicit Euler in q and u, h = motion.contact_time_step:
///
///     m (u^{n+1} - u^n)/h = -R(q^n) u^n + f^n,     q^{n+1} = q^n + h u^n.
///
/// The film damps at the rate R/m, which grows without bound as q falls: once h R(q)/m > 2 the velocity changes its sign at each step and grows,
/// and the sphere goes through the plane. (M) has no contact in finite time, by (I); this shows what a scheme that does not know it does. The trajectory ends with
/// a row of gap 0 where it goes through, or at the end of the motion.
/// Throws Error(kBadInput) when it leaves the fit's interval.
Trajectory simulate_explicit_euler(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
