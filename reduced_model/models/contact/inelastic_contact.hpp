// Plain inelastic contact, for comparison with viscous contact. q is the gap, u the velocity, m the
// mass, f_ext the external force, lambda the force of the contact; - and + mark values before and
// after an impact. Lengths, masses and times are in any consistent units. models.cpp lists the
// model. A change of results must raise kModelsRevision.
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Plain inelastic contact (Moreau 1988): the sphere stops on the wall and leaves it as soon as it
/// is pulled,
///
///     q >= 0,  lambda >= 0,  q lambda = 0,  m d^2q/dt^2 = f_ext + lambda,
///     u+ = max(u-, 0) where q = 0.
///
/// This is viscous contact with gamma_min = 0, that is without a memory. `force` is not used, and
/// nothing is thrown.
ContactModel inelastic_contact(const Motion& motion, const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
