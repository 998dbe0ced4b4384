// Viscous contact with the regular part of the fitted drag.
#pragma once

#include "viscontact/reduced_model/models/contact_model.hpp"

namespace viscontact {

/// The lecture's splitting ("Methode de splitting") where the fluid solver resolves all of the drag but its
/// singular part k/q. Each step is that of contact_step.hpp,
///
///     m (u^{n+1} - u^n) = h f^n - (G(q^{n+1}) - G(q^n)) + h lambda,     G(q) = int_0^q (R(s) - k/s) ds.
///
/// The lecture projects u^{n+1/2}, the velocity after a step with drag and lambda = 0. Drag then acts even on a sphere that contact holds at
/// rest, and gamma lacks the share h (R - k/q)/m of each step's load. Here the drag acts on the way that the sphere goes, by its impulse, so
/// that film and gamma agree with the first integral whatever the step: m u + G(q) + gamma = P(t).
/// Below the fit's interval R - k/q is held at its value there.
/// `force` must outlive the model. Throws Error(kBadInput) if the fit's resistance has no positive coefficient
/// of 1/q, or when the motion leaves the fit's interval upwards.
ContactModel viscous_contact_regular_drag(const Motion& motion, const LubricationForce& force);

/// Runs it (run_contact_model).
Trajectory simulate_viscous_contact_regular_drag(const Motion& motion,
                                                 const LubricationForce& force);

}  // namespace viscontact
