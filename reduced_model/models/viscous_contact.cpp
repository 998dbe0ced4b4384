// The model `viscous_contact`: contact at q = 0 and no resolved drag.
#include "viscontact/reduced_model/models/viscous_contact.hpp"

namespace viscontact {

ContactModel viscous_contact(const Motion& motion, const LubricationForce& force) {
  return contact_with_leading_term(motion, force);
}

Trajectory simulate_viscous_contact(const Motion& motion, const LubricationForce& force) {
  return run_contact_model(motion, viscous_contact(motion, force));
}

}  // namespace viscontact
