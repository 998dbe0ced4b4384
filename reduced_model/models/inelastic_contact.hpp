// Contact without memory, to see beside the viscous one.
#pragma once

#include "viscontact/reduced_model/models/contact_model.hpp"

namespace viscontact {

/// Plain inelastic contact (Moreau 1988): the sphere stops on the plane and leaves as soon as it is pulled,
///
///     q >= 0,  lambda >= 0,  q lambda = 0,  m d^2q/dt^2 = f_ext + lambda,  u+ = max(u-, 0) where q = 0:
///
/// viscous contact whose film remembers nothing, gamma_min = 0. The drag is not used.
ContactModel inelastic_contact(const Motion& motion, const LubricationForce& force);

/// Runs it (run_contact_model).
Trajectory simulate_inelastic_contact(const Motion& motion, const LubricationForce& force);

}  // namespace viscontact
