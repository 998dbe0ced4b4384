// Simulates membranes and rigid discs in a Stokes flow, docs/physics.md (8.1) to (8.8). Lengths,
// masses and times are in the units of the case. particle_simulation.hpp uses it. A change must
// keep that a continued run gives the same bits as an uninterrupted one.
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
/// where S(at) f are the velocities of the beads that the fluid gives with membranes at `at` under
/// the forces f, E is the bending energy and G the derivative of the lengths. P subtracts the
/// forces that the pressure inside balances, because they make no flow (Membranes::step). With the
/// positions x^n and x^{n-1} and the step k before, r = h/k, at = (1 + r) x^n - r x^{n-1}, and
/// `from` and `time` are those of the backward difference of second order; the first step is of
/// first order (docs/physics.md (8.6)). Discs move in the same steps, with the forces of the case,
/// or as they are driven. Beads of different membranes, discs and walls make viscous contact as
/// particles do: the impulses are loads beside P f, and the displacements without contact are the
/// free motion.
class MembraneSimulation {
 public:
  /// `setting.fluid` has membranes; the particles of `state` that are no beads are discs without
  /// mass, with forces or a given motion; `state` is what read_restart returned, or a state of
  /// which only the particles are set. For such a state the fluid solver computes the motion at the
  /// start, and its errors are thrown.
  MembraneSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  ~MembraneSimulation();

  /// Computes one step; see Simulation::step. Throws Error(kNotConverged) if the step does not
  /// converge, and the errors of FluidSolver. The state is then that before the step.
  StepReport step(double end);

  const State& state() const;  ///< after the last step

  /// The flow where the membranes were at the beginning of the last step.
  FlowField flow();
  /// The flow where the membranes are now.
  FlowField flow_at_present();

  /// Forces and torques of the fluid on the beads in the last step, motion_components() each.
  std::vector<double> fluid_forces() const;

  std::size_t unknowns() const;  ///< number of unknowns on the last mesh
  /// The largest resident memory of the solver so far [MiB].
  double solver_peak_memory_mebibytes() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace viscontact::particles
