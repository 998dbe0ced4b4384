// Declares the models `viscous_contact` and `viscous_contact_leapfrog` (physics.md (4.4) to (4.6)),
// and two models that differ from them by one term: `viscous_contact_regular_drag` (4.7), and
// `inelastic_contact` for comparison. q is the gap, u the velocity, m the mass, f_ext the external
// force, lambda the force of the contact on the sphere, gamma minus the impulse that the film of
// fluid has absorbed, k [M L/T] the coefficient of 1/q in the resistance R(q) [M/T]; - and + mark
// values before and after an impact. Lengths, masses and times are in any consistent units.
// models.cpp lists the models. The functions make a model and run nothing. All but
// inelastic_contact() throw Error(kBadInput) if the fit has no positive k; the motion is not
// checked. A change of results must raise kModelsRevision (trajectory.hpp).
#pragma once

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Makes the model of problem (P), which is the limit of the motion with inertia and the drag
/// -(k/q) u as the viscosity goes to 0 (Maury 2007, "A gluey particle model"; Lefebvre 2009,
/// "Numerical simulation of gluey particles"):
///
///     q >= 0,  gamma <= 0,  q gamma = 0,
///     m d^2q/dt^2 = f_ext + lambda,  lambda = 0 where q > 0,  dgamma/dt = -lambda,
///     u+ = 0 if gamma- < 0,  u+ = max(u-, 0) if gamma- = 0 and q = 0,  u+ = u- otherwise.
///
/// Only f_ext acts before contact. The scheme is that of contact_step.hpp with the step h
/// = viscous_contact.time_step, in which f_ext acts by its mean f^n over the step. With the initial
/// gap q0 [L], the first integral k ln q = k ln q0 + gamma gives the thickness q0 exp(gamma/k) of
/// the film that the model does not resolve. The solids touch when this thickness is the height r1
/// + r2 of the roughness of both surfaces; they never touch if this height is 0. Therefore gamma
/// >= gamma_min = k ln((r1 + r2)/q0), or 0 if r1 + r2 > q0 (Maury 2007 and Lefebvre 2008, who take
/// the radius for q0). Throws Error(kBadInput) if the fit's resistance has no positive coefficient
/// k of 1/q.
ContactModel viscous_contact(const Motion& motion, const lubrication::LubricationForce& force);

/// Makes the model of viscous_contact() with leapfrog steps of length h. If step n ends at the time
/// t^n, u^n and gamma^n are the values at the time t^n - h/2. The force of the step that begins at
/// t^n is the mean of f_ext from t^n - h/2 to t^n + h/2 (in the first step from 0 to h/2). Throws
/// the error of viscous_contact(). The error of the gap is of second order in h away from impacts.
ContactModel viscous_contact_leapfrog(const Motion& motion,
                                      const lubrication::LubricationForce& force);

/// Makes the model of the splitting of Lefebvre 2008 ("Methode de splitting", a lecture) for a
/// fluid solver that resolves the drag without its singular part k/q. Each step is that of
/// contact_step.hpp, with the step h and the mean external force f^n,
///
///     m (u^{n+1} - u^n) = h f^n - (Gamma_res(q^{n+1}) - Gamma_res(q^n)) + h lambda,
///     Gamma_res(q) = int_0^q (R(q') - k/q') dq'.
///
/// The lecture instead projects u^{n+1/2}, the velocity after a step with drag and lambda = 0. In
/// that scheme the drag acts even on a sphere at rest in contact, and in each step gamma lacks the
/// fraction h (R - k/q)/m of the load. Here the drag enters by its impulse along the path of the
/// sphere. Therefore film and gamma agree with the first integral for every step length: m u +
/// Gamma_res(q) + gamma is the impulse of the external force plus a constant. Below the fit's
/// interval of gaps R - k/q is taken as constant, and nothing is thrown. `force` must outlive the
/// model. Throws Error(kBadInput) if the fit's resistance has no positive coefficient of 1/q. A run
/// throws Error(kBadInput) if the sphere goes above the fit's interval and `force` has no formula
/// there.
ContactModel viscous_contact_regular_drag(const Motion& motion,
                                          const lubrication::LubricationForce& force);

/// Makes the model of plain inelastic contact (Moreau 1988). The sphere stops on the wall and
/// leaves the wall as soon as it is pulled:
///
///     q >= 0,  lambda >= 0,  q lambda = 0,  m d^2q/dt^2 = f_ext + lambda,
///     u+ = max(u-, 0) where q = 0.
///
/// This is viscous contact with gamma_min = 0, so that gamma is always 0. `motion` and `force` are
/// not used, and nothing is thrown.
ContactModel inelastic_contact(const Motion& motion, const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
