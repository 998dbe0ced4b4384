// Viscous contact with the regular part R(q) - k/q of the fitted resistance R (physics.md (4.7)). q
// is the gap, u the velocity, m the mass, gamma minus the impulse that the film has absorbed. k is
// the coefficient of 1/q in R. Lengths, masses and times are in any consistent units. models.cpp
// lists the model. A change of results must raise kModelsRevision.
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// The lecture's splitting (Lefebvre 2008, "Methode de splitting") for a fluid solver that resolves
/// the drag without its singular part k/q. Each step is that of contact_step.hpp, with the step h,
/// the mean external force f^n and the force lambda of the contact,
///
///     m (u^{n+1} - u^n) = h f^n - (Gamma_res(q^{n+1}) - Gamma_res(q^n)) + h lambda,
///     Gamma_res(q) = int_0^q (R(q') - k/q') dq'.
///
/// The lecture instead projects u^{n+1/2}, the velocity after a step with drag and lambda = 0. The
/// drag then acts even on a sphere at rest in contact, and in each step gamma lacks the fraction h
/// (R - k/q)/m of the load. Here the drag enters by its impulse along the path of the sphere. Film
/// and gamma therefore agree with the first integral for every step length: m u + Gamma_res(q) +
/// gamma is the impulse of the external force plus a constant. Below the fit's interval R - k/q is
/// constant. `force` must outlive the model. Throws Error(kBadInput) if the fit's resistance has no
/// positive coefficient of 1/q, or if the motion goes above the fit's interval.
ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
