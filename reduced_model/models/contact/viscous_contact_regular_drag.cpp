// The model `viscous_contact_regular_drag` (viscous_contact_regular_drag.hpp): contact at the gap q
// = 0 [L] and the regular drag R(q) - k/q [M/T]. A fit without k is an Error(kBadInput). A change
// of results must raise kModelsRevision.
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
