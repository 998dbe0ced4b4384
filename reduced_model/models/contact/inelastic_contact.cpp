// The model `inelastic_contact`: a contact model with gamma_min = 0 and no drag.
#include "viscontact/reduced_model/models/contact/inelastic_contact.hpp"

namespace viscontact::reduced_model {

ContactModel inelastic_contact(const Motion&, const lubrication::LubricationForce&) { return {}; }

}  // namespace viscontact::reduced_model
