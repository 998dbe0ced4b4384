// The model `viscous_contact_regular_drag`: contact at q = 0 and the regular drag R(q) - k/q.
#include "viscontact/reduced_model/models/viscous_contact_regular_drag.hpp"

namespace viscontact {

ContactModel viscous_contact_regular_drag(const Motion& motion, const LubricationForce& force) {
  ContactModel model = contact_with_leading_term(motion, force);
  model.drag = ResolvedDrag{[&force](double q) { return force.regular_resistance(q); },
                            [&force](double q) { return force.regular_impulse(q); }};
  return model;
}

Trajectory simulate_viscous_contact_regular_drag(const Motion& motion,
                                                 const LubricationForce& force) {
  return run_contact_model(motion, viscous_contact_regular_drag(motion, force));
}

}  // namespace viscontact
