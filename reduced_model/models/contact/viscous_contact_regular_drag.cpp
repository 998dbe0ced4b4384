// The model `viscous_contact_regular_drag`: contact at q = 0 and the regular drag R(q) - k/q. A
// change of its results must raise kModelsRevision.
#include "viscontact/reduced_model/models/contact/viscous_contact_regular_drag.hpp"

#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

namespace viscontact::reduced_model {

ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force) {
  ContactModel model = viscous_contact(motion, force);
  model.drag = ResolvedDrag{[&force](double q) { return force.regular_resistance(q); },
                            [&force](double q) { return force.regular_impulse(q); }};
  return model;
}

}  // namespace viscontact::reduced_model
