// The lecture's reference solution: no inertia, explicit Euler.
#pragma once

#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/motion.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact {

/// The sphere's drag balances the external force at each instant (Lefebvre 2008, "Couplage F_lub"):
///
///     F_lub(q^n, u^n) + f^n = 0,   that is u^n = f^n / R(q^n),
///     q^{n+1} = q^n + h u^n,
///
/// f^n the mean of f_ext over the step, h = motion.reference_time_step. First order in h; the film
/// comes out too thin. Throws Error(kNotConverged) when a step goes through the plane,
/// Error(kBadInput) when it leaves the fit's interval.
Trajectory simulate_reference(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
