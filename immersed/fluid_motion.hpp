// What a step in a fluid computes before it changes the state, and the impact of solids that
// rebound, docs/physics.md (6.11).
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/rebound.hpp"

namespace viscontact::particles {

/// Infinite if one of the numbers is NaN; 0 without numbers.
inline double largest_magnitude(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers)
    largest =
        std::max(largest, std::isnan(x) ? std::numeric_limits<double>::infinity() : std::abs(x));
  return largest;
}

inline void add_elements(std::span<const double> numbers, std::span<double> sums) {
  assert(sums.size() >= numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) sums[i] += numbers[i];
}

/// A step in which solids may collide. All references must outlive the object. Arrays of this file
/// have motion_components() numbers for each particle: velocities in [L/T, 1/T], forces in
/// [M L/T^2, M L^2/T^2].
struct FluidImpactStep {
  const Setting& setting;
  const State& state;                ///< before the step
  std::span<const Plane> obstacles;  ///< obstacles_of(setting)
  double end = 0;                    ///< time at which the step ends [T]
  /// Time [T], > 0, for which the forces of the step act on the velocities: the length of the step,
  /// or, in a fluid with inertia except with Coupling::kSplitting, that of the step before.
  double impulse_time = 0;
  std::span<const double> before;  ///< velocities at the beginning of the step
  /// The velocities that the forces of the step, without contact, give to particles at rest.
  std::function<std::vector<double>()> loaded;
};

/// The impact of a step: all its collisions, which count as one event, and the contacts on which
/// they press. It obeys Poisson's law of restitution (contact/restitution_law.hpp), with the
/// mobility of the fluid in place of the masses.
struct FluidImpact {
  /// In the order of StepContacts::contacts. Contact::impulse is that of the whole impact [M L/T],
  /// and Contact::lowest its lower bound: gamma, or the least impulse with which solids that
  /// rebound give back their share, or, if the impact was weakened so that it adds no energy, the
  /// impulse itself.
  std::vector<Contact<2>> contacts;
  /// For each contact the impulse [M L/T] with which FilmLaw::absorb() computes the new gamma.
  std::vector<double> absorbed;
  std::vector<std::vector<double>> of_gaps;  ///< StepContacts::of_gaps
  double amplification = 1;                  ///< StepContacts::amplification
  std::vector<double> loads;                 ///< contact forces: impulses over `impulse_time`
  std::vector<double> velocities;            ///< after the impact
  std::vector<double> moved;      ///< displacements in the step divided by its length [L/T, 1/T]
  std::vector<Rebound> rebounds;  ///< one for each contact whose solids rebound
  int iterations = 0;             ///< of all problems solved
  StagesRun stages;               ///< of the same
  bool is_solved = true;          ///< true: all problems reached the tolerances
};

/// Finds the impact of a step, which takes the place of `contacts`, the solution without
/// restitution. Returns nothing if in no contact that is hit the solids give back more than its
/// load in the step. A contact is hit if it closes in the step; if it was closed before, its
/// surfaces must also have approached each other at the beginning of the step, and if it bore a
/// load, faster than five times the velocity that the forces of the step cause.
std::optional<FluidImpact> solve_impact(const StepContacts& contacts, const FluidImpactStep& step,
                                        const Mobility& mobility,
                                        const ContactConditions& conditions);

/// The velocities and forces of a step, with the symbols U and U^+ of FluidSimulation.
struct FluidSimulation::Motion {
  std::vector<double> flow;    ///< U with contact
  std::vector<double> drag;    ///< forces of the particles on the fluid
  std::vector<double> free;    ///< U^+ without contact
  std::vector<double> moved;   ///< U^+ with contact: displacements divided by the step's length
  std::vector<double> linear;  ///< `moved`, but without the finite turns of rigid bodies
  bool links_hold = true;      ///< within the tolerance
  double buckling = 0;         ///< StepReport::buckling
  /// State::link_forces after the step.
  std::vector<double> link_forces,
      arm_powers;                ///< State::arm_powers
  std::vector<double> at_end;    ///< velocities at the end of the step
  std::vector<double> reported;  ///< `at_end` extrapolated from two meshes; empty without estimate
  /// Velocities at the beginning of the step for FluidSolver::keep_flow(); empty in a fluid without
  /// inertia.
  std::vector<double> kept;
  StepContacts contact;               ///< solved without restitution
  std::optional<FluidImpact> impact;  ///< takes the place of `contact` if solids rebound
  std::vector<double> after;  ///< velocities after the impact; `linear` if there is no impact
  /// Errors >= 0 of the impulses [M L/T] of `contact`, or of the impact; empty before examine().
  std::vector<double> impulse_errors;
  FluidStepReport fluid;
  FlowQuantities quantities;
  ForceErrors force_errors;
};

/// Relative error [1] by rounding of the velocities that a fluid solver returns. A penalty
/// multiplies it by about 1/penalty. With a penalty of 1e-6, for example, the velocities under the
/// sum of two forces differed from the sum of the velocities under each force by 2.4e-10. Both
/// constants are safely above the errors that were seen.
inline double error_of_answers(const Fluid& fluid) {
  constexpr double kError = 1e-9, kErrorByPenalty = 1e-15;
  if (fluid.constraint != RigidConstraint::kPenalty) return kError;
  assert(fluid.penalty > 0);
  return std::max(kError, kErrorByPenalty / fluid.penalty);
}

}  // namespace viscontact::particles
