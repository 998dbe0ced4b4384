// The models `viscous_contact`, its leapfrog, `viscous_contact_regular_drag` and
// `inelastic_contact`, physics.md (4.4) to (4.7), in any consistent units.
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Problem (P), the limit of the motion with inertia and the drag -(k/q) u as the viscosity goes to
/// 0 (Maury 2007, "A gluey particle model"; Lefebvre 2009, "Numerical simulation of gluey
/// particles"):
///
///     q >= 0,  gamma <= 0,  q gamma = 0,
///     m d^2q/dt^2 = f_ext + lambda,  lambda = 0 where q > 0,  dgamma/dt = -lambda,
///     u+ = 0 if gamma- < 0,  u+ = max(u-, 0) if gamma- = 0 and q = 0,  u+ = u- otherwise.
///
/// The scheme is that of contact_step.hpp with the step h = viscous_contact.time_step. With the
/// initial gap q0 [L], the first integral k ln q = k ln q0 + gamma gives the thickness q0
/// exp(gamma/k) of the film that the model does not resolve. The solids touch when this thickness
/// is the height r1 + r2 of the roughness of both surfaces. Therefore gamma >= gamma_min = k ln((r1
/// + r2)/q0), or 0 if r1 + r2 > q0 (Maury 2007 and Lefebvre 2008, who take the radius for q0).
/// Throws Error(kBadInput) if the fit's resistance has no positive coefficient k of 1/q.
ContactModel viscous_contact(const Motion& motion, const lubrication::LubricationForce& force);

/// viscous_contact() with leapfrog steps of length h: u^n and gamma^n are the values at the time
/// t^n - h/2. The force of the step that begins at t^n is the mean of f_ext from t^n - h/2 to t^n +
/// h/2 (in the first step from 0 to h/2). The error of the gap is of second order in h away from
/// impacts. Throws the error of viscous_contact().
ContactModel viscous_contact_leapfrog(const Motion& motion,
                                      const lubrication::LubricationForce& force);

/// The splitting of Lefebvre 2008 ("Methode de splitting", a lecture) for a fluid solver that
/// resolves the drag without its singular part k/q. Each step is that of contact_step.hpp,
///
///     m (u^{n+1} - u^n) = h f^n - (Gamma_res(q^{n+1}) - Gamma_res(q^n)) + h lambda,
///     Gamma_res(q) = int_0^q (R(q') - k/q') dq'.
///
/// The lecture instead projects u^{n+1/2}, the velocity after a step with drag and lambda = 0. In
/// that scheme the drag acts even on a sphere at rest in contact, and in each step gamma lacks the
/// fraction h (R - k/q)/m of the load. Here the drag enters by its impulse along the path of the
/// sphere, so that m u + Gamma_res(q) + gamma is the impulse of the external force plus a constant
/// for every step length. Below the fit's interval R - k/q is taken as constant; above it a run
/// throws Error(kBadInput) unless `force` has a formula there. `force` must outlive the model.
/// Throws the error of viscous_contact().
ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force);

/// Plain inelastic contact (Moreau 1988). The sphere stops on the wall and leaves it as soon as it
/// is pulled:
///
///     q >= 0,  lambda >= 0,  q lambda = 0,  m d^2q/dt^2 = f_ext + lambda,
///     u+ = max(u-, 0) where q = 0.
///
/// This is viscous contact with gamma_min = 0. Of the arguments, only force.largest_gap() is used.
ContactModel inelastic_contact(const Motion& motion, const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
