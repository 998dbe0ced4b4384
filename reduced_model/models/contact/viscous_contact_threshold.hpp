// Declares the model `viscous_contact_threshold`: viscous contact at a threshold gap q_c, with the
// whole fitted resistance R(q) at gaps q > q_c (physics.md (4.7)). Gamma is the primitive of R.
// gamma is minus the impulse that the film below q_c has absorbed, and gamma_min is the value of
// gamma at which the solids touch. m is the mass, u the velocity. Lengths, masses and times are in
// any consistent units. models.cpp lists the model. Error(kBadInput) is thrown if threshold,
// roughness, initial gap and the fit's interval of gaps do not fit together. A change of results
// must raise kModelsRevision (trajectory.hpp).
#pragma once

#include <algorithm>
#include <array>

#include "viscontact/reduced_model/models/contact/contact_model.hpp"

namespace viscontact::reduced_model {

/// Gap q_c [L], > 0, at which the model makes contact. Its default, a tenth of the smaller of
/// radius and initial gap, is a free choice; another default changes the results of cases without
/// the key.
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

/// Makes the model of the splitting of Lefebvre 2008 ("Methode de splitting", a lecture) for a
/// fluid solver that resolves the film down to the threshold gap q_c. The whole drag R(q) acts for
/// q > q_c, and the sphere is in contact at q_c. The film thickness is Gamma^{-1}(Gamma(q_c) +
/// gamma), and gamma_min = Gamma(r1 + r2) - Gamma(q_c), where r1 + r2 is the height of the
/// roughness of both surfaces; gamma_min is minus infinity for smooth surfaces. The drag enters by
/// its impulse (contact_step.hpp), so that in every step m u + Gamma(q) + gamma is the impulse of
/// the external force plus a constant, and the film of a sphere at rest is exact for every step
/// length. `force` must outlive the model. Throws Error(kBadInput) unless r1 + r2 < q_c < initial
/// gap, if the threshold has no value, or if q_c or a height r1 + r2 > 0 is outside the interval of
/// gaps of `force`. A run throws Error(kBadInput) if the sphere goes above this interval or the
/// film thickness goes below it, and Error(kNotConverged) if the film thickness is too small for a
/// double.
ContactModel viscous_contact_threshold(const Motion& motion,
                                       const lubrication::LubricationForce& force);

}  // namespace viscontact::reduced_model
