// Chooses the simulation for a setting, starts the fluid solver if there is a fluid, and passes
// calls on to the simulation. Numbers are in the units of the case: times [T], forces [M L/T^2] in
// the order of Particles::velocities, torques [M L^2/T^2] in the order of
// Particles::angular_velocities; for discs in a fluid, forces and torques are per length. Throws
// Error(kBadInput) for a state that does not fit the setting, Error(kNotConverged) for a step that
// cannot be computed, Error(kExternalProgram) for a fluid solver that fails, Error(kInterrupted)
// after a stop, and Error(kWrongUsage) if a caller sets forces on membranes in a fluid. A change
// must keep that no solver is started without a fluid, because FreeFEM may not be installed. run/,
// sweep/ and python/ use this file.
#include "viscontact/particles/run/particle_simulation.hpp"

#include <utility>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

/// Makes one of the three simulations: without a fluid, in a fluid, or in a fluid with membranes.
/// `threads` >= 1 (not checked) is used without a fluid only, `start_solver` with a fluid only.
ParticleSimulation::ParticleSimulation(const Setting& setting, State state, int threads,
                                       const StartFluidSolver& start_solver,
                                       const StopToken& stop) {
  if (!setting.fluid) {
    dry_ = std::make_unique<Simulation>(setting, std::move(state), threads);
    return;
  }
  const auto& p = state.particles;
  auto solver = start_solver(*setting.fluid, setting.domain, p.radii, p.dimension, stop);
  if (!setting.fluid->membranes.empty()) {
    membranes_ = std::make_unique<MembraneSimulation>(setting, std::move(state), std::move(solver));
    return;
  }
  in_fluid_ = std::make_unique<FluidSimulation>(setting, std::move(state), std::move(solver));
}

/// Computes a step that ends at the time `end` [T] at the latest; makes no step if the state has
/// reached this time.
StepReport ParticleSimulation::step(double end) {
  if (membranes_) return membranes_->step(end);
  return in_fluid_ ? in_fluid_->step(end) : dry_->step(end);
}

/// The forces that the caller may set; they act in the next steps.
std::span<double> ParticleSimulation::added_forces() {
  refuse_membranes();
  return in_fluid_ ? in_fluid_->added_forces() : dry_->added_forces();
}

/// The torques that the caller may set; empty if the particles do not turn.
std::span<double> ParticleSimulation::added_torques() {
  refuse_membranes();
  return in_fluid_ ? in_fluid_->added_torques() : dry_->added_torques();
}

void ParticleSimulation::refuse_membranes() const {
  if (membranes_)
    throw Error(ErrorKind::kWrongUsage,
                "membranes in a fluid take no forces of the caller; give forces in the case");
}

const State& ParticleSimulation::state() const {
  if (membranes_) return membranes_->state();
  return in_fluid_ ? in_fluid_->state() : dry_->state();
}

}  // namespace viscontact::particles
