// One interface to the simulations of many particles with and without a fluid, for runs and sweeps.
// Lengths, masses and times are in the units of the case.
#pragma once

#include <memory>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::pipeline {

/// A particles::FluidSimulation if the setting has a fluid, else a particles::Simulation.
class ParticleSimulation {
 public:
  /// `threads` >= 1 is the number of threads without a fluid. With a fluid, its solver starts, and
  /// errors are those of freefem_flow::start_fluid_solver.
  ParticleSimulation(const particles::Setting& setting, particles::State state, int threads,
                     const StopToken& stop);

  /// Computes a step that ends at the time `end` [T] at the latest; see Simulation::step and
  /// FluidSimulation::step, which say what is thrown.
  particles::StepReport step(double end);
  const particles::State& state() const;  ///< after the last step
  /// The particles with their velocities at the present time; see Simulation::reported_particles
  /// and FluidSimulation::reported_particles.
  particles::Particles reported_particles() const {
    return in_fluid_ ? in_fluid_->reported_particles() : dry_->reported_particles();
  }

  /// The blows of the last step; see Simulation::rebounds. None in a fluid.
  std::vector<particles::Rebound> rebounds() const {
    return dry_ ? dry_->rebounds() : std::vector<particles::Rebound>{};
  }

  /// True if there is a fluid. The functions below need one.
  bool has_fluid() const { return in_fluid_ != nullptr; }
  particles::FluidSimulation& fluid() { return *in_fluid_; }  ///< the simulation with a fluid

 private:
  std::unique_ptr<particles::Simulation> dry_;
  std::unique_ptr<particles::FluidSimulation> in_fluid_;
};

}  // namespace viscontact::pipeline
