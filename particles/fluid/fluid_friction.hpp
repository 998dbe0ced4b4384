// Coulomb's friction of contacts in a fluid, docs/physics.md (6.14): the tangents along which solids
// slide, and impulses of friction beside those that keep gaps open. Lengths, masses and times are in
// the units of the case; masses and impulses of discs are per length. fluid_contacts.cpp and
// fluid_acceptance.cpp use it. Errors are those of the mobility. A change must keep that the film
// carries no friction.
#pragma once

#include <array>
#include <span>

#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/pair_memory.hpp"
#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// What friction needs of a step besides ContactConditions.
struct FrictionOfStep {
  const Setting& setting;            ///< with ContactLaws::friction and a fluid, in the plane
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  const PairMemories& memories;      ///< of the pairs, whose friction is the first guess
  double begin = 0;                  ///< time at which the step begins [T]
  double end = 0;                    ///< time at which it ends [T]
};

/// Where friction acts on the particles of a contact.
struct FrictionPlace {
  /// Distances, along the normal, of the contact from the centres of the first and the second
  /// particle [L].
  std::array<double, 2> arms{};
  Vector on_obstacle{};  ///< the point of the obstacle at the contact [L]
};

/// The friction of a contact, without ContactFrictionInFluid::contact. `contact` has the gap
/// between the surfaces, and the particles are where the step begins. The first guess of the
/// impulse is that in the memory of the pair.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           const FrictionPlace& place,
                                           const ContactConditions& conditions);

/// Solves for contacts as solve_listed(), with the friction of `step.frictions`, of which
/// `mu_s` >= 0 is the coefficient, without dimension. If Coulomb's law (5.7) is not reached within
/// the tolerances, `step.is_solved` is false, and the friction has the bounds (5.17) of given loads;
/// gaps and films are exact for the friction that was found. Throws what the mobility throws.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// The heat that friction makes in a unit of time [M L^2/T^3], >= 0 but for the tolerances: minus the
/// sum of the forces of friction times the slips of the step, for the velocities with which the
/// particles move.
double heat_of_friction(const StepContacts& step, std::span<const double> velocities,
                        const ContactConditions& conditions);

/// Takes the residuals of Coulomb's law into `residuals`, for the velocities that the particles have
/// with the contact forces [L/T, 1/T]. The residual of a contact is its slip where it sticks, and
/// the error of its friction times its tangential mobility where it slides [L].
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
