// Simulates membranes (closed curves through particles, their beads) and rigid discs in a Stokes
// flow, docs/physics.md (8.1) to (8.8).
#pragma once

#include <memory>
#include <vector>

#include "viscontact/immersed/flow_simulation.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// Membranes in a Stokes flow, per unit length of the third dimension. A step of length h solves
///
///     (z - from)/time = S(at) P f(z),   f(z) = -grad E(z) - G(z)^T tension,   lengths(z) kept,
///
/// for the positions z [L] of the beads at its end. S(at) f are the velocities that the fluid gives
/// the beads at the places `at` under the forces f. E is the bending energy, lengths(z) are the
/// lengths of the parts of the membranes, G is their derivative, and tension are the forces that
/// keep them. P subtracts the forces that the pressure inside balances. With the ratio r of the
/// step to the one before, at = (1 + r) x^n - r x^{n-1}, and `from` and `time` are those of the
/// backward difference of second order; the first step is of first order. Discs move in the same
/// steps. Beads of different membranes, discs and walls make viscous contact, whose forces are
/// added to P f.
class MembraneSimulation : public FlowSimulation {
 public:
  /// `setting.fluid` has membranes. The particles of `state` that are no beads are discs without
  /// mass. `state` is that of a restart file, or a state of which only the particles are set; the
  /// fluid solver then computes the velocities at the start. Throws Error(kBadInput) if membranes
  /// of a restart file have other lengths or areas than those of the case (check_shapes()).
  MembraneSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver);
  ~MembraneSimulation() override;

  /// Computes one step of the length Setting::time_step, or up to the time `end` [T] if this is
  /// nearer. If the state has reached `end`, computes no step and returns a report without
  /// contacts. Throws Error(kNotConverged) if the equations of the membranes are not solved, or if
  /// a contact leaves an overlap of more than the mean radius, and the errors of FluidSolver; the
  /// state is then that before the step.
  StepReport step(double end) override;

  const State& state() const override;

  /// Membranes take no forces and torques of the caller.
  std::span<double> added_forces() override;
  std::span<double> added_torques() override;

  FlowField flow() override;
  FlowField flow_at_present() override;

  /// Before the first step they are the forces at the start.
  std::vector<double> fluid_forces() const override;

  std::size_t unknowns() const override;
  double solver_peak_memory_mebibytes() const override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace viscontact::particles
