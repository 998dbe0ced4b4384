// The model `inelastic_contact`: a contact model with gamma_min = 0 [M L/T] and no drag
// (inelastic_contact.hpp); nothing is thrown. A change of results must raise kModelsRevision.
#include "viscontact/reduced_model/models/contact/inelastic_contact.hpp"

namespace viscontact::reduced_model {

ContactModel inelastic_contact(const Motion&, const lubrication::LubricationForce&) { return {}; }

}  // namespace viscontact::reduced_model
