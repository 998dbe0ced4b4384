// What a step in a fluid computes before it changes the state (fluid_simulation.hpp). Velocities
// are in [L/T, 1/T], forces in [M L/T^2, M L^2/T^2], in the units of the case. Nothing is thrown. A
// change must keep the state unchanged until a step is accepted.
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "viscontact/particles/fluid/fluid_blow.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"

namespace viscontact::particles {

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
