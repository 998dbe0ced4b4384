// The blow of a step between solids that rebound in a fluid, docs/physics.md (6.11): Poisson's
// restitution of contact/restitution_law.hpp, with the mobility of the fluid in place of masses.
// Lengths, masses and times are in the units of the case; impulses and gamma of discs are per
// length. Results must depend on the order of the particles by rounding errors only.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/impacts/rebound.hpp"
#include "viscontact/particles/setting.hpp"

namespace viscontact::particles {

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

}  // namespace viscontact::particles
