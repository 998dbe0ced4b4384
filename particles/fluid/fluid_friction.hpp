// Coulomb's friction of contacts in a fluid, docs/physics.md (6.14): the tangents along which solids
// slide, and impulses of friction beside those that keep gaps open. Lengths, masses and times are
// in the units of the case; masses and impulses of discs are per length. fluid_contacts.cpp and
// fluid_acceptance.cpp use it. Errors are those of the mobility. A change must keep that the film
// carries no friction.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/particles/domain/plane.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/pair_memory.hpp"
#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// What friction needs of a step besides ContactConditions.
struct FrictionOfStep {
  const Setting& setting;            ///< with ContactLaws::friction and a fluid
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  const PairMemories& memories;      ///< of the pairs, whose friction is the first guess
  double begin = 0;                  ///< time at which the step begins [T]
  double end = 0;                    ///< time at which it ends [T]
};

/// The friction of contact number `contact` of a step. `pair` is the pair of the contact, and
/// `arms` are the distances [L], along the normal, of the contact from the centres of the first and
/// the second particle. The impulse is the one that the memory of the pair has.
ContactFrictionInFluid friction_of_contact(const FrictionOfStep& step, const Particles& particles,
                                           const Pair& pair, const Contact<2>& contact,
                                           std::size_t number, const std::array<double, 2>& arms,
                                           const ContactConditions& conditions);

/// Solves for contacts as solve_listed(), with the friction of `step.frictions`, of which `mu_s` >= 0
/// is the coefficient. If Coulomb's law is not reached within the tolerances, `step.is_solved` is
/// false; gaps and films are exact all the same, for the friction that was found.
void solve_with_friction(StepContacts& step, double mu_s, const Mobility& mobility,
                         const ContactConditions& conditions);

/// Takes the residuals of Coulomb's law into `residuals`, for the velocities that the particles have
/// with the contact forces. That of a contact is the natural map's, as a length: its slip where it
/// sticks, and the error of its friction times its tangential mobility where it slides [L].
void take_residuals_of_friction(const StepContacts& step, double mu_s,
                                std::span<const double> velocities,
                                const ContactConditions& conditions, StepResiduals& residuals);

}  // namespace viscontact::particles
