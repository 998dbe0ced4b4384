#include "viscontact/particle_runs/run/start_simulation.hpp"

#include <cassert>
#include <utility>

#include "viscontact/contact_dynamics/simulation.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/immersed/membrane_simulation.hpp"
#include "viscontact/suspensions/suspension_simulation.hpp"

namespace viscontact::particles {

std::unique_ptr<ParticleSimulation> start_simulation(const Setting& setting, State state,
                                                     int threads,
                                                     const StartFluidSolver& start_solver,
                                                     const StopToken& stop) {
  assert(threads >= 1);
  if (setting.lubrication)
    return std::make_unique<SuspensionSimulation>(setting, std::move(state), threads);
  if (!setting.fluid) return std::make_unique<Simulation>(setting, std::move(state), threads);
  const auto& p = state.particles;
  auto solver = start_solver(*setting.fluid, setting.domain, shapes_of(p), p.dimension, stop);
  if (!setting.fluid->membranes.empty())
    return std::make_unique<MembraneSimulation>(setting, std::move(state), std::move(solver));
  return std::make_unique<FluidSimulation>(setting, std::move(state), std::move(solver));
}

SuspensionSimulation* suspension_of(ParticleSimulation& simulation) {
  return dynamic_cast<SuspensionSimulation*>(&simulation);
}

}  // namespace viscontact::particles
