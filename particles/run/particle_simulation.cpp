// Chooses the simulation for a setting, starts the fluid solver if there is a fluid, and passes
// calls on. Numbers are in the units of the case: times [T], forces [M L/T^2] in the order of
// Particles::velocities, torques [M L^2/T^2]; `threads` is at least 1 and not used with a fluid.
// Throws Error(kBadInput) for a state that does not fit the setting, Error(kNotConverged) for a
// step that cannot be computed, Error(kExternalProgram) for a fluid solver that fails,
// Error(kInterrupted) after a stop, and Error(kWrongUsage) if a caller sets forces on membranes in
// a fluid. A change must keep that no solver is started without a fluid: FreeFEM may not be
// installed. Used by run/, sweep/ and python/.
#include "viscontact/particles/run/particle_simulation.hpp"

#include <utility>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

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

/// Makes no step if the state has reached the time `end` [T].
StepReport ParticleSimulation::step(double end) {
  if (membranes_) return membranes_->step(end);
  return in_fluid_ ? in_fluid_->step(end) : dry_->step(end);
}

std::span<double> ParticleSimulation::added_forces() {
  refuse_membranes();
  return in_fluid_ ? in_fluid_->added_forces() : dry_->added_forces();
}

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
