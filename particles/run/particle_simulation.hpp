// One interface to the simulations of many particles with and without a fluid, for runs and sweeps.
// Lengths, masses and times are in the units of the case. A change must keep that both simulations
// answer each function in the same way. Used by particles_stage.cpp and sweep/.
#pragma once

#include <memory>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

/// A particles::FluidSimulation if the setting has a fluid, else a particles::Simulation.
class ParticleSimulation {
 public:
  /// `threads` >= 1 is the number of threads without a fluid. With a fluid, `start_solver` is
  /// called and its errors are thrown.
  ParticleSimulation(const Setting& setting, State state, int threads,
                     const StartFluidSolver& start_solver, const StopToken& stop);

  /// Computes a step that ends at the time `end` [T] at the latest; see Simulation::step and
  /// FluidSimulation::step, which say what is thrown.
  StepReport step(double end);
  const State& state() const;  ///< after the last step
  /// The particles with their velocities at the present time; see Simulation::reported_particles
  /// and FluidSimulation::reported_particles.
  Particles reported_particles() const {
    return in_fluid_ ? in_fluid_->reported_particles() : dry_->reported_particles();
  }

  /// The blows of the last step; see Simulation::rebounds and FluidSimulation::rebounds.
  const std::vector<Rebound>& rebounds() const {
    return in_fluid_ ? in_fluid_->rebounds() : dry_->rebounds();
  }

  /// True if there is a fluid. The functions below need one.
  bool has_fluid() const { return in_fluid_ != nullptr; }
  FluidSimulation& fluid() { return *in_fluid_; }  ///< the simulation with a fluid

 private:
  std::unique_ptr<Simulation> dry_;
  std::unique_ptr<FluidSimulation> in_fluid_;
};

}  // namespace viscontact::particles
