// The interface of all simulations of many particles.
#pragma once

#include <span>

#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rebound.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Computes the motion of many particles step by step. Units are those of the case; of discs in a
/// fluid masses, forces and torques are per length.
class ParticleSimulation {
 public:
  virtual ~ParticleSimulation() = default;

  /// Computes a step that ends at the time `end` [T] at the latest; none if no time is left until
  /// `end`. Throws Error(kNotConverged) if the step cannot be computed; the state is then that
  /// before the step.
  virtual StepReport step(double end) = 0;

  virtual const State& state() const = 0;
  /// The state for a restart file, with what another process keeps of it.
  virtual State state_to_save() { return state(); }
  /// The particles with their velocities at the present time, in a scheme that keeps velocities of
  /// another time, or extrapolates them.
  virtual Particles reported_particles() const { return state().particles; }

  /// Forces on the particles [M L/T^2] that the caller may set between steps, in the order of
  /// Particles::velocities, in addition to those of the setting; 0 at first. The state does not
  /// contain them. Throws Error(kWrongUsage) if the simulation takes none.
  virtual std::span<double> added_forces() = 0;
  /// Torques [M L^2/T^2] with the same rules, in the order of Particles::angular_velocities; empty
  /// if the particles do not turn.
  virtual std::span<double> added_torques() = 0;

  /// The collisions of solids in the last step, in order of time; empty without restitution.
  virtual std::span<const Rebound> rebounds() const { return {}; }

 protected:
  ParticleSimulation() = default;
  ParticleSimulation(const ParticleSimulation&) = default;
  ParticleSimulation(ParticleSimulation&&) = default;
  ParticleSimulation& operator=(const ParticleSimulation&) = default;
  ParticleSimulation& operator=(ParticleSimulation&&) = default;
};

}  // namespace viscontact::particles
