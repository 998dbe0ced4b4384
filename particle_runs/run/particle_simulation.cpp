// Chooses the simulation for a setting and passes calls on to it.
#include "viscontact/particle_runs/run/particle_simulation.hpp"

#include <cassert>
#include <utility>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

ParticleSimulation::ParticleSimulation(const Setting& setting, State state, int threads,
                                       const StartFluidSolver& start_solver,
                                       const StopToken& stop) {
  assert(threads >= 1);
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
