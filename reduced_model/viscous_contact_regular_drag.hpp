// Viscous contact with the regular part of the fitted drag.
#pragma once

#include "reduced_model/contact_model.hpp"

namespace viscontact {

/// The lecture's splitting ("Methode de splitting") where the fluid solver resolves all of the drag but its
/// singular part k/q. With the drag implicit, each step is
///
///     m (u^{n+1} - u^n)/h = f^n - (R(q^n) - k/q^n) u^{n+1} + lambda,
///
/// lambda from the projection of viscous_contact.hpp: the velocity is that of the lecture's scheme, which projects
/// the u^{n+1/2} of lambda = 0, but drag acts on the velocity that is left. (Taken on u^{n+1/2} it would act on a
/// sphere at rest in contact, and gamma would lack the share h (R - k/q)/m of each step's load.)
/// Below the fit's interval R - k/q is held at its value there.
/// `force` must outlive the model. Throws Error(kBadInput) if the fit's resistance has no positive coefficient
/// of 1/q, or when the motion leaves the fit's interval upwards.
ContactModel viscous_contact_regular_drag(const Motion& motion, const LubricationForce& force);

/// Runs it (run_contact_model).
Trajectory simulate_viscous_contact_regular_drag(const Motion& motion,
                                                 const LubricationForce& force);

}  // namespace viscontact
