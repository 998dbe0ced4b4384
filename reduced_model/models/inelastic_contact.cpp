// The model `inelastic_contact`: a contact model with gamma_min = 0 and no drag.
#include "viscontact/reduced_model/models/inelastic_contact.hpp"

namespace viscontact {

ContactModel inelastic_contact(const Motion&, const LubricationForce&) { return {}; }

Trajectory simulate_inelastic_contact(const Motion& motion, const LubricationForce& force) {
  return run_contact_model(motion, inelastic_contact(motion, force));
}

}  // namespace viscontact
