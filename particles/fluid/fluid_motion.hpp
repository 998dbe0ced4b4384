// What a step in a fluid computes before it changes the state (fluid_simulation.hpp), and the blow
// of a step between solids that rebound, docs/physics.md (6.11): Poisson's restitution of
// contact/restitution_law.hpp, with the mobility of the fluid in place of masses. Velocities are in
// [L/T, 1/T], forces in [M L/T^2, M L^2/T^2], in the units of the case; impulses and gamma of discs
// are per length. Nothing is thrown. A change must keep the state unchanged until a step is
// accepted, and results may depend on the order of the particles by rounding errors only.
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

/// The largest absolute value; infinity if a number is NaN, so that comparisons see it.
inline double largest_magnitude(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers)
    largest =
        std::max(largest, std::isnan(x) ? std::numeric_limits<double>::infinity() : std::abs(x));
  return largest;
}

/// Adds `numbers` to `sums`, which has as many, element by element.
inline void add_elements(std::span<const double> numbers, std::span<double> sums) {
  for (std::size_t i = 0; i < numbers.size(); ++i) sums[i] += numbers[i];
}

/// The step in which solids may be hit. All references must outlive the object.
struct BlowStep {
  const Setting& setting;            ///< its laws have a restitution
  const State& state;                ///< before the step
  std::span<const Plane> obstacles;  ///< of the setting
  double end = 0;                    ///< time at which the step ends [T]
  /// Time for which the forces of the step act on the velocities [T], > 0. It is the length of the
  /// step, but in a fluid with inertia that of the step before (FlowStep::length).
  double kick = 0;
  std::span<const double> before;  ///< velocities at the beginning of the step [L/T, 1/T]
  /// The velocities that the loads of the step give to particles at rest, without contacts [L/T,
  /// 1/T].
  std::function<std::vector<double>()> loaded;
};

/// The blow of a step. All contacts that are hit in the step take part, and those that they press
/// on.
struct FluidBlow {
  /// Of all contacts of the step, in the order of StepContacts::contacts: the problem of the
  /// restitution, with the impulses of the whole step, loads included.
  std::vector<Contact<2>> contacts;
  /// For each contact what its film takes up [M L/T]: gamma before the step minus gamma after it.
  std::vector<double> absorbed;
  std::vector<double> loads;       ///< impulses over `kick`, on each particle [M L/T^2]
  std::vector<double> velocities;  ///< after the blow [L/T, 1/T]
  std::vector<double> moved;       ///< displacements in the step over its length [L/T, 1/T]
  std::vector<Rebound> rebounds;   ///< of the contacts whose solids touch
  int iterations = 0;              ///< as ContactProblem::iterations()
  bool is_solved = true;           ///< as StepContacts::is_solved
};

/// Finds the blow of a step, if the solids of a contact give back more than its load. `contacts` is
/// the solution of the step without restitution, of which the blow takes the place. A contact is
/// hit if it closes in the step; one that is closed before the step only if it approached before
/// it, faster than five times the velocity that the load of the step gives if it bore a load.
/// Throws what `mobility` throws.
std::optional<FluidBlow> solve_blow(const StepContacts& contacts, const BlowStep& step,
                                    const Mobility& mobility, const ContactConditions& conditions);

/// The velocities and forces of a step.
struct FluidSimulation::Motion {
  std::vector<double> flow;         ///< velocities in the fluid's problem: U, with contact
  std::vector<double> drag;         ///< forces of the particles on the fluid
  std::vector<double> free;         ///< U^+ without contact
  std::vector<double> moved;        ///< velocities with which the particles move: U^+ with contact
  std::vector<double> linear;       ///< `moved` without the finite turns of rigid bodies
  bool links_hold = true;           ///< whether hinges and arms hold within the tolerance
  std::vector<double> link_forces,  ///< State::link_forces after the step
      arm_powers;                   ///< State::arm_powers after the step [M L^2/T^3]
  std::vector<double> at_end;       ///< u^{n+1}
  std::vector<double> reported;  ///< u^{n+1} extrapolated from two meshes; empty without estimate
  std::vector<double> kept;      ///< in a fluid with inertia: velocities in the next step's problem
  StepContacts contact;          ///< the contacts of the step, solved
  std::optional<FluidBlow> blow;       ///< takes the place of `contact` if solids rebound
  std::vector<double> after;           ///< with contact, after the blow; `linear` if there is none
  std::vector<double> impulse_errors;  ///< of contact.contacts, StepResiduals::impulse_errors
  FluidStepReport fluid;               ///< what the step reports
  FlowQuantities quantities;           ///< dissipation, apparent viscosity and forces of the flow
  ForceErrors force_errors;  ///< estimates of the errors of the forces; empty if they were not made
};

/// Relative rounding error of the velocities that a fluid solver answers. With a penalty they are
/// rounded like numbers 1/penalty times as large: answers were seen to differ from linearity by
/// 2.4e-10 with a penalty of 1e-6.
inline double error_of_answers(const Fluid& fluid) {
  constexpr double kError = 1e-9, kErrorByPenalty = 1e-15;
  if (fluid.constraint != RigidConstraint::kPenalty) return kError;
  return std::max(kError, kErrorByPenalty / fluid.penalty);
}

}  // namespace viscontact::particles
