// What a step in a fluid computes before it changes the state (fluid_simulation.hpp), and the blow
// of solids that rebound in a step, docs/physics.md (6.11). A blow obeys Poisson's law of
// restitution (contact/restitution_law.hpp), with the mobility of the fluid in place of the masses.
// Arrays whose shape is not given have motion_components() numbers for each particle: velocities in
// [L/T, 1/T], forces in [M L/T^2, M L^2/T^2]; forces and impulses of discs are per length. gamma <=
// 0 is minus the impulse that the film of a contact has absorbed. The other sources of this folder
// and case/ use it. Nothing is checked; only solve_blow() throws. A change must keep the state
// unchanged until a step is accepted, and that the order of the particles changes results by
// rounding errors only.
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

/// The largest absolute value of `numbers`, in their unit. It is infinite if one of them is NaN,
/// because a comparison with NaN would be false, and 0 if there are no numbers.
inline double largest_magnitude(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers)
    largest =
        std::max(largest, std::isnan(x) ? std::numeric_limits<double>::infinity() : std::abs(x));
  return largest;
}

/// Adds each of `numbers` to the element of `sums` at the same place. `sums` must have at least as
/// many elements.
inline void add_elements(std::span<const double> numbers, std::span<double> sums) {
  for (std::size_t i = 0; i < numbers.size(); ++i) sums[i] += numbers[i];
}

/// A step in which solids may collide. All references must outlive the object.
struct BlowStep {
  const Setting& setting;            ///< a case with a fluid and a law of restitution
  const State& state;                ///< the state before the step
  std::span<const Plane> obstacles;  ///< obstacles_of(setting): walls and then planes
  double end = 0;                    ///< time at which the step ends [T], > that of `state`
  /// Time [T], > 0, for which the forces of the step act on the velocities. It is the length of the
  /// step, or in a fluid with inertia the length of the step before (FlowStep::length).
  double kick = 0;
  std::span<const double> before;  ///< velocities at the beginning of the step
  /// Returns the velocities that the forces of the step, without contact, give to particles that
  /// were at rest.
  std::function<std::vector<double>()> loaded;
};

/// The blow of a step: all collisions in the step, which count as one event, and the contacts on
/// which these collisions press.
struct FluidBlow {
  /// All contacts of the step, in the order of StepContacts::contacts. Contact::impulse is the
  /// impulse of the whole blow [M L/T]. Contact::lowest is the lower bound of this impulse: gamma,
  /// or, if the solids of the contact rebound, the least impulse with which they give back their
  /// share. If the blow was weakened so that it adds no energy, the lower bound is the impulse
  /// itself.
  std::vector<Contact<2>> contacts;
  /// For each contact the impulse [M L/T] with which FilmLaw::absorb() computes the new gamma: the
  /// whole impulse, or, if its solids rebound, gamma before the step minus gamma after it.
  std::vector<double> absorbed;
  std::vector<std::vector<double>> of_gaps;  ///< StepContacts::of_gaps, in the same order
  double amplification = 1;                  ///< StepContacts::amplification
  std::vector<double> loads;       ///< contact forces on each particle: impulses over `kick`
  std::vector<double> velocities;  ///< velocities after the blow
  std::vector<double> moved;       ///< displacements in the step divided by its length [L/T, 1/T]
  std::vector<Rebound> rebounds;   ///< one for each contact whose solids rebound
  int iterations = 0;              ///< sum of StepContacts::iterations of all problems solved
  bool is_solved = true;           ///< true: all problems reached the tolerances
};

/// Finds the blow of a step, which takes the place of `contacts`, the solution of the step without
/// restitution. Returns nothing if in no contact that is hit the solids give back more than its
/// load in the step. A contact is hit if it closes in the step. If it was closed before the step,
/// its surfaces must also have approached each other at the beginning of the step; if it also bore
/// a load, faster than five times the velocity that the forces of the step cause. Throws what
/// `mobility` and BlowStep::loaded throw. If a problem is not solved, FluidBlow::is_solved is
/// false.
std::optional<FluidBlow> solve_blow(const StepContacts& contacts, const BlowStep& step,
                                    const Mobility& mobility, const ContactConditions& conditions);

/// The velocities and forces of a step, with the symbols of fluid_simulation.hpp: U are the
/// velocities that the fluid gives the particles at their places before the step, U^+ the
/// velocities with which the particles move.
struct FluidSimulation::Motion {
  std::vector<double> flow;    ///< U with contact
  std::vector<double> drag;    ///< forces of the particles on the fluid
  std::vector<double> free;    ///< U^+ without contact
  std::vector<double> moved;   ///< U^+ with contact: displacements divided by the step's length
  std::vector<double> linear;  ///< `moved`, but without the finite turns of rigid bodies
  bool links_hold = true;      ///< whether hinges and arms hold within the tolerance
  double buckling = 0;         ///< StepReport::buckling
  /// State::link_forces after the step, Links::force_count() numbers; empty without links.
  std::vector<double> link_forces,
      arm_powers;                ///< State::arm_powers, one for each arm [M L^2/T^3]
  std::vector<double> at_end;    ///< velocities at the end of the step
  std::vector<double> reported;  ///< `at_end` extrapolated from two meshes; empty without estimate
  /// Velocities of the particles at the beginning of the step, which FluidSolver::keep_flow() keeps
  /// with the flow; empty in a fluid without inertia.
  std::vector<double> kept;
  StepContacts contact;           ///< the contacts of the step, solved without restitution
  std::optional<FluidBlow> blow;  ///< takes the place of `contact` if solids rebound
  std::vector<double> after;      ///< velocities after the blow; `linear` if there is no blow
  /// Errors >= 0 of the impulses [M L/T], one for each of contact.contacts: those of the blow if
  /// there is one. examine() sets this member, which is empty before.
  std::vector<double> impulse_errors;
  FluidStepReport fluid;      ///< what the step reports
  FlowQuantities quantities;  ///< dissipation, apparent viscosity and forces of the flow
  /// Estimates >= 0 of the errors of forces [M L/T^2, M L^2/T^2]. Both arrays are empty if no
  /// estimates were made.
  ForceErrors force_errors;
};

/// Relative error [1], > 0, of the velocities that a fluid solver returns, by rounding. A penalty
/// multiplies the error by about 1/penalty. With a penalty of 1e-6, for example, the velocities
/// under the sum of two forces differed from the sum of the velocities under each force by 2.4e-10.
/// Both constants are safely above the errors that were seen. `fluid.penalty` must be > 0 with
/// RigidConstraint::kPenalty; otherwise it is not used.
inline double error_of_answers(const Fluid& fluid) {
  constexpr double kError = 1e-9, kErrorByPenalty = 1e-15;
  if (fluid.constraint != RigidConstraint::kPenalty) return kError;
  return std::max(kError, kErrorByPenalty / fluid.penalty);
}

}  // namespace viscontact::particles
