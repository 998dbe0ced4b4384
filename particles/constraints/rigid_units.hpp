// Makes the units of a constraint problem from particles and rigid bodies. Lengths, masses and times
// are in the units of the case.
#pragma once

#include "viscontact/particles/bodies/body_step.hpp"
#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// The unit of a particle without a body: its mobility h/m [T/M] and turn mobility h/I [T/(M L^2)],
/// and its motion without constraints, D numbers `displacement` [L] and kTurns numbers `turn` [rad].
template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn);

/// The unit of a rigid body with this motion without constraints.
template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free);

}  // namespace viscontact::particles
