// What is recorded of one step of a simulation, for steps.csv and run.json. Lengths, masses and
// times are in the units of the case. Simulations fill it, and particles/run writes it. A change
// must keep what the columns of steps.csv mean.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace viscontact::particles {

/// Three estimates of errors, each relative to the largest result, >= 0; < 0: not made.
struct RelativeErrors {
  double best = -1;         ///< of the most accurate results, extrapolated from two meshes
  double of_one_mesh = -1;  ///< of the results on the mesh of the placement, which move particles
  double of_penalty = -1;   ///< the part of both that is the error of the penalty
};

/// What is recorded of one step in a fluid.
struct FluidStepReport {
  double dissipation = 0;  ///< of the flow [M L^2/T^3], in two dimensions per unit length
  /// Apparent viscosity over that of the fluid [1], docs/physics.md (6.6); 0 if the flow without
  /// particles does not dissipate or is not known (FlowQuantities).
  double apparent_viscosity = 0;
  // In a fluid with inertia:
  double kinetic_energy = 0;   ///< of the fluid [M L^2/T^2], in two dimensions per unit length
  double reynolds_number = 0;  ///< largest rho_f |V| 2 r/mu of a particle of velocity V, radius r
  double courant_number = 0;   ///< FlowQuantities::courant_number
  /// Sum of the forces of the fluid on the particles whose motion is given [M L/T^2]; on an axis
  /// the first is that along z.
  std::array<double, 2> given_force{};
  double flow_time = 0;  ///< time of the flow that the step has computed [T]
  /// FlowQuantities::probes at that time; empty in a step that the next one computes again.
  std::vector<std::array<double, 2>> probes{};
  double seconds = 0;  ///< wall time of the step: mesh, fluid solver and contacts [s]
  /// Errors of the velocities of the particles; < 0 if they were not estimated in this step.
  RelativeErrors velocity_errors;
  /// Errors of the forces of the fluid; < 0 if they were not estimated in this step.
  RelativeErrors force_errors;
};

/// What is recorded of one step. Here D + h G v is the linearised gap of a contact after the step
/// [L], p its impulse [M L/T], gamma the Pair::gamma before the step [M L/T], and w the change of
/// the gap per impulse [T/M].
struct StepReport {
  double time = 0;           ///< at the end of the step [T]
  std::size_t contacts = 0;  ///< number of contacts in the projection
  std::size_t glued = 0;     ///< number of contacts with gamma < 0 after the step
  int iterations = 0;        ///< sum over all parts of the step
  /// Largest residual |min(D + h G v, w (p - gamma))| of a close pair, divided by the mean radius.
  double residual = 0;
  /// Largest residual divided by w and by the impulses at work on the particles of the contact
  /// (docs/particles.md, "The projection").
  double impulse_residual = 0;
  bool converged = true;  ///< the residuals of all contacts are within the tolerances
  /// Largest residual over what is allowed for its contact or link, >= 0; infinite if the step did
  /// not converge for another reason.
  double excess = 0;
  /// Largest overlap -(D + h G v) after the step, divided by the mean radius. It is computed from
  /// linearised gaps; no gap is smaller than its linearised gap.
  double largest_overlap = 0;
  /// Number of parts that the step was divided into, 1 to 256, because a step is halved at most 8
  /// times (simulation.hpp).
  int parts = 0;
  /// Number of contacts that turn further than kLargestTurn (contact.hpp) in the smallest parts.
  std::size_t unresolved = 0;
  FluidStepReport fluid{};  ///< zeros without a fluid
};

}  // namespace viscontact::particles
