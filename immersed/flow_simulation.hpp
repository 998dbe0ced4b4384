// The interface of simulations of particles in a flow.
#pragma once

#include <cstddef>
#include <vector>

#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/particles/steps/particle_simulation.hpp"

namespace viscontact::particles {

/// Estimates of the errors of the forces of one step, >= 0 [M L/T^2, M L^2/T^2]; empty if there are
/// none.
struct ForceErrors {
  std::vector<double> of_fluid;  ///< errors of FluidSimulation::fluid_forces()
  std::vector<double> of_links;  ///< errors of State::link_forces
};

/// All functions, step() included, throw the errors of FluidSolver.
class FlowSimulation : public ParticleSimulation {
 public:
  /// The flow of the last step, around the places of the particles at its beginning.
  virtual FlowField flow() = 0;
  /// The flow around the particles at their present places.
  virtual FlowField flow_at_present() = 0;

  /// Forces and torques of the fluid on the particles in the last step: for each disc the force
  /// along x, along y [M/T^2] and the torque [M L/T^2], per length; for each sphere on an axis the
  /// force along z [M L/T^2]. Empty before the first step.
  virtual std::vector<double> fluid_forces() const = 0;
  /// Estimates of the errors of fluid_forces() and of forces of links in the last step; empty if no
  /// estimates were made.
  virtual ForceErrors force_errors() const { return {}; }

  /// Unknowns on the last mesh; 0 if the solver does not say.
  virtual std::size_t unknowns() const = 0;
  /// The largest memory of the solver so far [MiB]; 0 if it runs in this process.
  virtual double solver_peak_memory_mebibytes() const = 0;
};

}  // namespace viscontact::particles
