// One interface to simulations of many particles without a fluid, in a fluid, with membranes.
#pragma once

#include <cassert>
#include <memory>
#include <span>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/immersed/membrane_simulation.hpp"

namespace viscontact::particles {

/// Holds a MembraneSimulation if the setting has a fluid with membranes, a FluidSimulation if it
/// has another fluid, else a Simulation. Units are those of the case; of discs in a fluid masses,
/// forces and torques are per length.
class ParticleSimulation {
 public:
  /// `threads` >= 1 is used without a fluid only. With a fluid, `start_solver` starts the fluid
  /// solver, which ends if `stop` requests a stop; without one no solver is started, because
  /// FreeFEM may not be installed. Throws Error(kBadInput) if `state` does not fit the setting. The
  /// errors of the fluid solver, in this constructor and below, are Error(kExternalProgram) if it
  /// cannot start, ends or answers with anything but numbers, and Error(kInterrupted) if a stop was
  /// requested.
  ParticleSimulation(const Setting& setting, State state, int threads,
                     const StartFluidSolver& start_solver, const StopToken& stop);

  /// Computes a step that ends at the time `end` [T] at the latest; none if no time is left until
  /// `end`. Throws Error(kNotConverged) if the step cannot be computed, and the errors of the fluid
  /// solver.
  StepReport step(double end);
  const State& state() const;
  /// Forces on the particles [M L/T^2] that the caller may set, in the order of
  /// Particles::velocities; see Simulation::added_forces(). Throws Error(kWrongUsage) if there is a
  /// fluid with membranes.
  std::span<double> added_forces();
  /// Torques on the particles [M L^2/T^2] that the caller may set, in the order of
  /// Particles::angular_velocities; empty if the particles do not turn. Throws as added_forces()
  /// does.
  std::span<double> added_torques();
  /// The particles at the present time; see Simulation::reported_particles().
  Particles reported_particles() const {
    return in_fluid_ ? in_fluid_->reported_particles()
                     : (dry_ ? dry_->reported_particles() : state().particles);
  }

  /// The collisions of solids with restitution in the last step, in order of time; none with
  /// membranes.
  std::span<const Rebound> rebounds() const {
    if (membranes_) return {};
    return in_fluid_ ? in_fluid_->rebounds() : dry_->rebounds();
  }

  /// The functions below need a fluid.
  bool has_fluid() const { return dry_ == nullptr; }
  /// The flow around the particles where they were at the beginning of the last step. Throws the
  /// errors of the fluid solver.
  FlowField flow() {
    assert(has_fluid());
    return membranes_ ? membranes_->flow() : in_fluid_->flow();
  }
  /// The flow around the particles where they are now. Throws as flow() does.
  FlowField flow_at_present() {
    assert(has_fluid());
    return membranes_ ? membranes_->flow_at_present() : in_fluid_->flow_at_present();
  }
  /// Forces and torques of the fluid on the particles in the last step: for each disc the force
  /// along x, along y [M/T^2] and the torque [M L/T^2], per length; for each sphere on an axis the
  /// force along z [M L/T^2]. Empty before the first step.
  std::vector<double> fluid_forces() const {
    assert(has_fluid());
    return membranes_ ? membranes_->fluid_forces() : in_fluid_->fluid_forces();
  }
  /// Estimates of the errors of fluid_forces() and of forces of links in the last step; empty if no
  /// estimates were made, and with membranes.
  ForceErrors force_errors() const {
    assert(has_fluid());
    return membranes_ ? ForceErrors{} : in_fluid_->force_errors();
  }
  /// The state for the restart file, with the flow of a fluid with inertia. Throws as flow() does.
  State state_to_save() {
    assert(has_fluid());
    return membranes_ ? state() : in_fluid_->state_to_save();
  }
  /// The number on the last mesh of the fluid solver; 0 if the solver does not tell it.
  std::size_t unknowns() const {
    assert(has_fluid());
    return membranes_ ? membranes_->unknowns() : in_fluid_->unknowns();
  }
  /// The memory of the process of the fluid solver so far; 0 if it runs in this process.
  double solver_peak_memory_mebibytes() const {
    assert(has_fluid());
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
