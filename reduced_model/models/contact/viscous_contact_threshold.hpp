// The model `viscous_contact_threshold`: viscous contact at a threshold gap q_c, with the whole
// fitted resistance R(q) at gaps q > q_c, physics.md (4.7).
#pragma once

#include <algorithm>
#include <array>

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Gap q_c [L], > 0, at which the model makes contact.
inline constexpr ModelParameter kThresholdGap = {
    "viscous_contact.threshold_gap",
    "threshold gap",
    "L",
    kPositive,
    [](const Motion& motion, double radius) { return std::min(radius, motion.initial_gap) / 10; },
    false,
    "a tenth of the smaller of radius and `initial_gap`"};
/// The parameters of viscous_contact_threshold().
inline constexpr std::array kThresholdParameters = {kContactTimeStep, kThresholdGap, kRestitution};

/// The splitting of Lefebvre 2008 ("Methode de splitting", a lecture) for a fluid solver that
/// resolves the film down to q_c. With the primitive Gamma of R and minus the impulse gamma that
/// the film below q_c has absorbed, the film thickness is Gamma^{-1}(Gamma(q_c) + gamma), and
/// gamma_min = Gamma(r1 + r2) - Gamma(q_c), where r1 + r2 is the height of the roughness of both
/// surfaces; -infinity for smooth surfaces. In every step m u + Gamma(q) + gamma is the impulse of
/// the external force plus a constant, so that the film of a sphere at rest is exact for every step
/// length. `force` must outlive the model. Throws Error(kBadInput) unless r1 + r2 < q_c < initial
/// gap, if the threshold has no value, or if q_c or a height r1 + r2 > 0 is outside the interval of
/// `force`. A run throws Error(kBadInput) if the sphere goes above this interval or the film
/// thickness below it, and Error(kNotConverged) if the latter is too small for a double.
ContactModel viscous_contact_threshold(const Motion& motion,
                                       const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
