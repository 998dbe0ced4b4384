// The model `inelastic_contact`: a contact model with gamma_min = 0 and no drag. A change of its
// results must raise kModelsRevision.
#include "viscontact/reduced_model/models/contact/inelastic_contact.hpp"

namespace viscontact::reduced_model {

ContactModel inelastic_contact(const Motion&, const lubrication::LubricationForce&) { return {}; }

}  // namespace viscontact::reduced_model
