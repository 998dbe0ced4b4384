// Chooses the simulation for a setting.
#pragma once

#include <memory>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/immersed/flow_simulation.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/steps/particle_simulation.hpp"

namespace viscontact::particles {

class SuspensionSimulation;

/// A SuspensionSimulation if the setting has lubrication, a MembraneSimulation if it has a fluid
/// with membranes, a FluidSimulation if it has another fluid, else a Simulation. `threads` >= 1 is
/// used without a fluid only. With a fluid, `start_solver` starts the fluid solver, which ends if
/// `stop` requests a stop; without one no solver is started, because FreeFEM may not be installed.
/// Throws Error(kBadInput) if `state` does not fit the setting. The errors of the fluid solver,
/// here and in the simulation, are Error(kExternalProgram) if it cannot start, ends or answers with
/// anything but numbers, and Error(kInterrupted) if a stop was requested.
std::unique_ptr<ParticleSimulation> start_simulation(const Setting& setting, State state,
                                                     int threads,
                                                     const StartFluidSolver& start_solver,
                                                     const StopToken& stop);

/// The simulation of spheres with lubrication; null if it is another one.
SuspensionSimulation* suspension_of(ParticleSimulation& simulation);

/// What the simulation tells of its flow; null without a fluid.
inline FlowSimulation* flow_of(ParticleSimulation& simulation) {
  return dynamic_cast<FlowSimulation*>(&simulation);
}

}  // namespace viscontact::particles
