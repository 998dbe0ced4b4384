// What is recorded of one step of a simulation, for steps.csv and run.json, and how far its
// solution misses its conditions, by which it is accepted: the same for particles with masses
// (projection/) and in a fluid (fluid/). A residual is how far a gap or a length is from what its
// condition asks, [L]; docs/particles.md, "The projection", says what is allowed. Lengths, masses
// and times are in the units of the case. Simulations fill the report, and particles/run writes it.
// A change must keep what the columns of steps.csv mean; a change of a limit changes which steps
// are accepted.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

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
  double reynolds_number = 0;  ///< largest rho_f |V| 2 r/mu of a particle
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
/// [L], p its impulse, gamma that before the step, and w the change of the gap per impulse [T/M].
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

/// The residuals of all contacts and links of a step.
struct StepResiduals {
  double largest = 0;  ///< [L]
  double excess = 0;   ///< largest residual, divided by what is allowed for its contact or link
  /// Largest residual as an impulse, divided by the impulses at work in its contact or link.
  double of_impulses = 0;
  double smallest_gap = 0;  ///< smallest linearised gap after the step [L], at most 0
  Pair deepest_overlap;     ///< the pair with the smallest gap
  bool converged = true;    ///< all residuals are allowed
  /// Of each contact [M L/T], >= 0: its residual divided by its mobility Contact::w.
  std::vector<double> impulse_errors;

  /// Takes in a residual >= 0 for which `allowed` > 0 is allowed [L]. Returns true if it is larger
  /// than allowed, or not a number; then `converged` becomes false.
  bool take(double residual, double allowed);
  /// Takes in the residual of an impulse [M L/T]; `at_work` >= 0 are the impulses at work [M L/T].
  void take_impulse(double residual, double at_work);
  /// Takes in the gap of a pair after the step [L]. A gap that is not a number stays the smallest.
  void take_gap(double gap, const Pair& pair);
};

/// Adds the residuals of a step, or of one part of a divided step, to the report. `mean_radius` > 0
/// [L].
void report_residuals(const StepResiduals& residuals, double mean_radius, StepReport& report);

/// Throws Error(kNotConverged) if a step that ends at `time` [T] has not converged and leaves an
/// overlap of more than the mean radius [L]. `reason` says what may be the cause.
void refuse_deep_overlap(const StepResiduals& residuals, const Particles& particles,
                         const Setting& setting, double mean_radius, double time,
                         const std::function<std::string()>& reason);

/// "particles 3 and 4", "particle 3 and plane 1": a pair in messages, with the ids of its
/// particles. All obstacles are called planes if the domain has no walls.
std::string name_of_pair(const Pair& pair, const Particles& particles, const Setting& setting);

}  // namespace viscontact::particles
