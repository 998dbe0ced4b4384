// Simulates membranes (closed curves through particles, their beads) and rigid discs in a Stokes
// flow, docs/physics.md (8.1) to (8.8). Lengths [L], masses [M] and times [T] are in the units of
// the case file; M stands for a mass per length of the third dimension. Values of the setting are
// not checked. A step that cannot be computed throws Error(kNotConverged), a fluid solver that
// fails Error(kExternalProgram), a stop that is requested Error(kInterrupted).
// run/particle_simulation.hpp uses the class. A change must keep that a run from a restart file
// gives the same bits as an uninterrupted run.
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
/// for the positions z [L] of the beads at its end. S(at) f are the velocities that the fluid gives
/// the beads at the places `at` under the forces f. E is the bending energy, lengths(z) are the
/// lengths of the parts of the membranes, G is their derivative by z, and tension are the forces
/// that keep them. P subtracts the forces that the pressure inside balances, because they make no
/// flow (Membranes::step). x^n and x^{n-1} are the positions at the beginning of the step and of
/// the step before, whose length is k, and r is h/k. The places are at = (1 + r) x^n - r x^{n-1};
/// `from` and `time` are those of the backward difference of second order. The first step is of
/// first order (docs/physics.md (8.6)). Discs move in the same steps, under the forces of the case
/// or with given motions. Beads of different membranes, discs and walls make viscous contact as
/// other particles in a fluid do; the forces of the contacts are added to P f.
class MembraneSimulation {
 public:
  /// `setting.fluid` must have membranes, and `solver` must not be null (both are not checked). The
  /// particles of `state` that are no beads are discs without mass, with forces or a given motion.
  /// `state` is the state of a restart file, as read_restart() returns it, or a state of which only
  /// the particles are set. In the second case the fluid solver computes the velocities at the
  /// start, and its errors are thrown. Throws Error(kBadInput) if membranes of a restart file have
  /// other lengths or areas than those of the case (check_shapes()).
  MembraneSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  ~MembraneSimulation();

  /// Computes one step of the length Setting::time_step, or up to the time `end` [T] if this is
  /// nearer (StepGrid::next). If the state has reached `end`, computes no step and returns a report
  /// without contacts. Throws Error(kNotConverged) if the equations of the membranes are not
  /// solved, or if a contact leaves an overlap of more than the mean radius. Throws the errors of
  /// FluidSolver, also Error(kInterrupted) if a stop is requested. After an error the state is that
  /// before the step. A smaller residual that is not allowed throws nothing, but
  /// StepReport::converged is then false.
  StepReport step(double end);

  const State& state() const;  ///< the state after the last step

  /// The flow with the membranes and discs at their places before the last step. There must have
  /// been a step (asserted). Throws the errors of FluidSolver.
  FlowField flow();
  /// The flow with the membranes and discs at their present places. Throws the errors of
  /// FluidSolver.
  FlowField flow_at_present();

  /// Forces of the fluid on all particles in the last step: x, y [M L/T^2] and torque [M L^2/T^2]
  /// of each particle. Before the first step they are the forces at the start.
  std::vector<double> fluid_forces() const;

  std::size_t unknowns() const;  ///< number of unknowns on the last mesh; 0 if it is not known
  /// The largest resident memory of the solver so far [MiB]; 0 if the solver runs in this process.
  double solver_peak_memory_mebibytes() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace viscontact::particles
