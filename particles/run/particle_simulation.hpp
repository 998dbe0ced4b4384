// One interface to the three simulations of many particles: without a fluid, in a fluid, and in a
// fluid with membranes. Lengths, masses and times are in the units of the case. A step that cannot
// be computed throws Error(kNotConverged), a fluid solver that fails Error(kExternalProgram), a
// stop Error(kInterrupted). Used by particles_stage.cpp, sweep/ and python/. A change must keep
// that a function means the same for all three.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/particles/fluid/fluid_simulation.hpp"
#include "viscontact/particles/fluid/membrane_simulation.hpp"
#include "viscontact/particles/simulation.hpp"

namespace viscontact::particles {

/// Holds a MembraneSimulation if the setting has a fluid with membranes, a FluidSimulation if it
/// has another fluid, else a Simulation.
class ParticleSimulation {
 public:
  /// `threads` >= 1 is the number of threads; it is used without a fluid only. With a fluid,
  /// `start_solver` starts the fluid solver, which ends if `stop` requests a stop. Its errors are
  /// thrown, here and below Error(kExternalProgram) if it cannot start, ends or answers with
  /// anything but numbers, and Error(kInterrupted) if a stop was requested; also those of the
  /// constructors of the three simulations, Error(kBadInput) if `state` does not fit the setting.
  ParticleSimulation(const Setting& setting, State state, int threads,
                     const StartFluidSolver& start_solver, const StopToken& stop);

  /// Computes a step that ends at the time `end` [T] at the latest. Throws Error(kNotConverged) if
  /// the step cannot be computed, and the errors of the fluid solver; see Simulation::step() and
  /// FluidSimulation::step(). If no time is left until `end`, no step is made.
  StepReport step(double end);
  const State& state() const;  ///< the state after the last step
  /// Forces on the particles [M L/T^2] that the caller may set; see Simulation::added_forces().
  /// Throws Error(kWrongUsage) if there is a fluid with membranes.
  std::span<double> added_forces();
  /// Torques [M L^2/T^2], likewise; empty if the particles do not turn.
  std::span<double> added_torques();
  /// The particles with their velocities at the present time; see Simulation::reported_particles()
  /// and FluidSimulation::reported_particles().
  Particles reported_particles() const {
    return in_fluid_ ? in_fluid_->reported_particles()
                     : (dry_ ? dry_->reported_particles() : state().particles);
  }

  /// The blows of solids with restitution in the last step, in order of time.
  std::span<const Rebound> rebounds() const {
    if (membranes_) return {};
    return in_fluid_ ? in_fluid_->rebounds() : dry_->rebounds();
  }

  /// True if there is a fluid, which the functions below need (not checked).
  bool has_fluid() const { return dry_ == nullptr; }
  /// The flow around the particles where they were at the beginning of the last step. Throws the
  /// errors of the fluid solver.
  FlowField flow() { return membranes_ ? membranes_->flow() : in_fluid_->flow(); }
  /// The flow around the particles where they are now. Throws the errors of the fluid solver.
  FlowField flow_at_present() {
    return membranes_ ? membranes_->flow_at_present() : in_fluid_->flow_at_present();
  }
  /// Forces and torques of the fluid on each particle in the last step [M L/T^2, M L^2/T^2]: x, y
  /// and torque, on an axis z alone; empty before the first step.
  std::vector<double> fluid_forces() const {
    return membranes_ ? membranes_->fluid_forces() : in_fluid_->fluid_forces();
  }
  /// Estimates of the errors of the forces in the last step; empty if they were not made.
  ForceErrors force_errors() const {
    return membranes_ ? ForceErrors{} : in_fluid_->force_errors();
  }
  /// The state, with the flow of a fluid with inertia, for the restart file. Throws the errors of
  /// the fluid solver.
  State state_to_save() { return membranes_ ? state() : in_fluid_->state_to_save(); }
  /// Number of unknowns on the last mesh; 0 if the solver does not say.
  std::size_t unknowns() const {
    return membranes_ ? membranes_->unknowns() : in_fluid_->unknowns();
  }
  /// Largest memory of the fluid solver so far [MiB]; 0 if it runs in this process.
  double solver_peak_memory_mebibytes() const {
    return membranes_ ? membranes_->solver_peak_memory_mebibytes()
                      : in_fluid_->solver_peak_memory_mebibytes();
  }

 private:
  void refuse_membranes() const;

  std::unique_ptr<Simulation> dry_;
  std::unique_ptr<FluidSimulation> in_fluid_;
  std::unique_ptr<MembraneSimulation> membranes_;
};

}  // namespace viscontact::particles
