// The model `explicit_euler`, which shows how a scheme that does not respect the first integral
// fails. Lengths, masses and times are in any one consistent system of units.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// Problem (M) (physics.md (4.1)) by explicit Euler in q and u, with h = viscous_contact.time_step:
///
///     m (u^{n+1} - u^n)/h = -R(q^n) u^n + f^n,     q^{n+1} = q^n + h u^n.
///
/// The film damps at the rate R/m, which grows without bound as q falls. As soon as h R(q)/m > 2,
/// the velocity changes its sign at each step and grows, and the sphere goes through the wall,
/// although (M) has no contact in finite time by the first integral (4.2). The trajectory ends with
/// a row of gap 0 where the sphere goes through the wall, or at the end of the motion. Throws
/// Error(kBadInput) if the motion leaves the fit's interval.
Trajectory simulate_explicit_euler(const Motion& motion,
                                   const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
