// Simulates membranes (closed curves through particles, their beads) and rigid discs in a Stokes
// flow, docs/physics.md (8.1) to (8.8). Lengths, masses and times are in the units of the case
// file; M stands for a mass per length of the third dimension. run/particle_simulation.hpp uses it.
// A step that cannot be computed throws Error(kNotConverged), a fluid solver that fails
// Error(kExternalProgram), a stop Error(kInterrupted). A change must keep that a run from a restart
// file gives the same bits as an uninterrupted one.
#pragma once

#include <memory>
#include <vector>

#include "viscontact/particles/fluid/fluid_solver.hpp"
#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Membranes in a Stokes flow. A step of length h solves
///
///     (z - from)/time = S(at) P f(z),   f(z) = -grad E(z) - G(z)^T tension,   lengths(z) kept,
///
/// for the positions z of the beads at its end. S(at) f are the velocities that the fluid gives the
/// beads at the places `at` under the forces f, E is the bending energy, and G the derivative of
/// the lengths. P subtracts the forces that the pressure inside balances, because they make no flow
/// (Membranes::step). With the positions x^n and x^{n-1} at the beginning of the step and of the
/// step before, whose length is k, and with r = h/k, the places are at = (1 + r) x^n - r x^{n-1};
/// `from` and `time` are those of the backward difference of second order. The first step is of
/// first order (docs/physics.md (8.6)). Discs move in the same steps, under the forces of the case
/// or with given motions. Beads of different membranes, discs and walls make viscous contact as
/// other particles in a fluid do; the forces of the contacts are added to P f.
class MembraneSimulation {
 public:
  /// `setting.fluid` has membranes, and `solver` is not null (not checked). The particles of
  /// `state` that are no beads are discs without mass, with forces or a given motion. `state` is
  /// what read_restart returned, or a state of which only the particles are set. In the second case
  /// the fluid solver computes the velocities at the start, and its errors are thrown. Throws
  /// Error(kBadInput) if membranes of a restart file have another shape than those of the case
  /// (check_shapes()).
  MembraneSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  ~MembraneSimulation();

  /// Computes one step of the length Setting::time_step, which ends at `end` [T] if that is earlier
  /// (StepGrid::next). Does nothing if the state has reached `end`. Throws Error(kNotConverged) if
  /// the membranes' equations are not solved or a contact leaves an overlap of more than the mean
  /// radius (a smaller residual only makes StepReport::converged false), and the errors of
  /// FluidSolver, also Error(kInterrupted) if a stop is requested. The state is then that before
  /// the step.
  StepReport step(double end);

  const State& state() const;  ///< after the last step

  /// The flow with the membranes and discs at their places before the last step; there must have
  /// been a step (asserted). Throws the errors of FluidSolver.
  FlowField flow();
  /// The flow with the membranes and discs at their present places. Throws as flow() does.
  FlowField flow_at_present();

  /// Forces of the fluid on all particles in the last step, for each one x, y [M L/T^2] and torque
  /// [M L^2/T^2]; before the first step those at the start.
  std::vector<double> fluid_forces() const;

  std::size_t unknowns() const;  ///< number of unknowns on the last mesh; 0: not known
  /// The largest resident memory of the solver so far [MiB].
  double solver_peak_memory_mebibytes() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace viscontact::particles
