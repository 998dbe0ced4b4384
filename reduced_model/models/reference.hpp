// The model `reference`, the lecture's reference solution (physics.md (4.3)): no inertia, explicit
// Euler. q is the gap, u the velocity, F_lub the lubrication force, R the resistance. Lengths,
// masses and times are in any consistent units. models.cpp lists the model. A change of results
// must raise kModelsRevision.
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
/// is of first order in h. The film that it computes is too thin. Throws Error(kNotConverged) if a
/// step goes through the wall, and Error(kBadInput) if the motion leaves the fit's interval.
Trajectory simulate_reference(const Motion& motion, const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
