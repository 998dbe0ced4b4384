// What a step in a fluid computes before it changes the state (fluid_simulation.hpp), and the blow
// of solids that rebound in a step, docs/physics.md (6.11): Poisson's law of restitution
// (contact/restitution_law.hpp), in which the mobility of the fluid takes the place of the masses.
// Arrays whose shape is not given have motion_components() numbers for each particle: velocities in
// [L/T, 1/T], forces in [M L/T^2, M L^2/T^2]; forces and impulses of discs are per length. gamma <=
// 0 is minus the impulse that the film of a contact has absorbed. The other sources of this folder
// and case/ use it. Nothing is checked. A change must keep the state unchanged until a step is
// accepted, and that results depend on the order of the particles by rounding errors only.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

/// The largest absolute value; infinity if a number is NaN, so that comparisons see it; 0 if there
/// are no numbers.
inline double largest_magnitude(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers)
    largest =
        std::max(largest, std::isnan(x) ? std::numeric_limits<double>::infinity() : std::abs(x));
  return largest;
}

/// Adds `numbers` to `sums`, which has at least as many, element by element.
inline void add_elements(std::span<const double> numbers, std::span<double> sums) {
  for (std::size_t i = 0; i < numbers.size(); ++i) sums[i] += numbers[i];
}

/// A step in which solids may collide. All references must outlive the object.
struct BlowStep {
  const Setting& setting;            ///< its laws have a restitution, and it has a fluid
  const State& state;                ///< before the step
  std::span<const Plane> obstacles;  ///< obstacles_of(setting): walls and then planes
  double end = 0;                    ///< time at which the step ends [T], > that of `state`
  /// Time for which the forces of the step act on the velocities [T], > 0: the length of the step,
  /// in a fluid with inertia that of the step before (FlowStep::length).
  double kick = 0;
  std::span<const double> before;  ///< velocities at the beginning of the step
  /// Returns the velocities that the forces of the step give to particles at rest, without contact.
  std::function<std::vector<double>()> loaded;
};

/// The blow of a step: all collisions in it, which count as one event, and the contacts on which
/// they press.
struct FluidBlow {
  /// All contacts of the step, in the order of StepContacts::contacts. Contact::impulse is that of
  /// the whole blow [M L/T]. Contact::lowest is its lower bound: gamma, or, if the solids of the
  /// contact rebound, the least impulse with which they give back their share. If the blow was
  /// weakened so that it adds no energy, it is the impulse itself.
  std::vector<Contact<2>> contacts;
  /// For each contact the impulse that is offered to its film [M L/T]: the whole impulse, or, if
  /// its solids rebound, gamma before the step minus gamma after it.
  std::vector<double> absorbed;
  std::vector<double> loads;       ///< contact forces, impulses over `kick`, on each particle
  std::vector<double> velocities;  ///< after the blow
  std::vector<double> moved;       ///< displacements in the step over its length [L/T, 1/T]
  std::vector<Rebound> rebounds;   ///< one for each contact whose solids rebound
  int iterations = 0;              ///< sum of StepContacts::iterations of all problems solved
  bool is_solved = true;           ///< all problems reached the tolerances
};

/// Finds the blow of a step, which takes the place of `contacts`, the solution of the step without
/// restitution. There is none unless the solids of a contact give back more than its load in the
/// step. A contact is hit if it closes in the step. One that is closed before the step must
/// moreover have approached at its beginning, and if it bore a load, faster than five times the
/// velocity that the forces of the step cause. Throws what `mobility` and BlowStep::loaded throw;
/// if a problem is not solved, FluidBlow::is_solved is false.
std::optional<FluidBlow> solve_blow(const StepContacts& contacts, const BlowStep& step,
                                    const Mobility& mobility, const ContactConditions& conditions);

/// The velocities and forces of a step, with the symbols of fluid_simulation.hpp: U is the velocity
/// that the fluid gives at the places before the step, U^+ that with which particles move.
struct FluidSimulation::Motion {
  std::vector<double> flow;    ///< U with contact
  std::vector<double> drag;    ///< forces of the particles on the fluid
  std::vector<double> free;    ///< U^+ without contact
  std::vector<double> moved;   ///< U^+ with contact: displacements over the length of the step
  std::vector<double> linear;  ///< `moved`, but without the finite turns of rigid bodies
  bool links_hold = true;      ///< whether hinges and arms hold within the tolerance
  /// State::link_forces after the step, Links::force_count() numbers; empty without links.
  std::vector<double> link_forces,
      arm_powers;                ///< State::arm_powers, one for each arm [M L^2/T^3]
  std::vector<double> at_end;    ///< velocities at the end of the step
  std::vector<double> reported;  ///< `at_end` extrapolated from two meshes; empty without estimate
  /// In a fluid with inertia, else empty: velocities of the particles at the beginning of the step,
  /// which FluidSolver::keep_flow() keeps with the flow.
  std::vector<double> kept;
  StepContacts contact;           ///< the contacts of the step, solved
  std::optional<FluidBlow> blow;  ///< takes the place of `contact` if solids rebound
  std::vector<double> after;      ///< velocities after the blow; `linear` if there is none
  /// Errors >= 0 of the impulses, one for each of contact.contacts [M L/T]: those of the blow if
  /// there is one. examine() sets it; empty before.
  std::vector<double> impulse_errors;
  FluidStepReport fluid;      ///< what the step reports
  FlowQuantities quantities;  ///< dissipation, apparent viscosity and forces of the flow
  /// Estimates >= 0 of the errors of forces [M L/T^2, M L^2/T^2]; both arrays are empty if none
  /// were made.
  ForceErrors force_errors;
};

/// Relative error > 0 of the velocities that a fluid solver answers, by rounding. A penalty
/// multiplies it by about 1/penalty: with a penalty of 1e-6, the answers to two forces and to their
/// sum differed by 2.4e-10. Both constants are safely above what was seen. `fluid.penalty` must be
/// > 0 with kPenalty; it is not used otherwise.
inline double error_of_answers(const Fluid& fluid) {
  constexpr double kError = 1e-9, kErrorByPenalty = 1e-15;
  if (fluid.constraint != RigidConstraint::kPenalty) return kError;
  return std::max(kError, kErrorByPenalty / fluid.penalty);
}

}  // namespace viscontact::particles
