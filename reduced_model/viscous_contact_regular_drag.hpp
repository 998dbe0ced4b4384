// Viscous contact with the regular part of the fitted drag.
#pragma once

#include "reduced_model/contact_model.hpp"

namespace viscontact {

/// The lecture's splitting ("Methode de splitting") where the fluid solver resolves all of the drag
/// but its singular part k/q: each step is
///
///     m (u^{n+1/2} - u^n)/h = f^n - (R(q^n) - k/q^n) u^{n+1/2},
///
/// then the projection of viscous_contact.hpp on u^{n+1/2}. Below the fit's interval R - k/q is
/// held at its value there.
ContactModel viscous_contact_regular_drag(const Motion& motion, const LubricationForce& force);

/// Runs it (run_contact_model).
Trajectory simulate_viscous_contact_regular_drag(const Motion& motion,
                                                 const LubricationForce& force);

}  // namespace viscontact
