// Chooses the simulation for a setting (particle_simulation.hpp), and starts the fluid solver.
#include "viscontact/pipeline/particles/particle_simulation.hpp"

#include <utility>

#include "viscontact/freefem_flow/freefem_solver.hpp"

namespace viscontact::pipeline {

ParticleSimulation::ParticleSimulation(const particles::Setting& setting, particles::State state,
                                       int threads, const StopToken& stop) {
  if (!setting.fluid) {
    dry_ = std::make_unique<particles::Simulation>(setting, std::move(state), threads);
    return;
  }
  const auto& p = state.particles;
  auto solver =
      freefem_flow::start_fluid_solver(*setting.fluid, setting.domain, p.radii, p.dimension, stop);
  in_fluid_ =
      std::make_unique<particles::FluidSimulation>(setting, std::move(state), std::move(solver));
}

particles::StepReport ParticleSimulation::step(double end) {
  return in_fluid_ ? in_fluid_->step(end) : dry_->step(end);
}

const particles::State& ParticleSimulation::state() const {
  return in_fluid_ ? in_fluid_->state() : dry_->state();
}

}  // namespace viscontact::pipeline
