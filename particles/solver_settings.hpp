// When the projection of a time step has converged.
#pragma once

namespace viscontact::particles {

/// Tolerances have no dimension; docs/particles.md says how each is measured.
struct SolverSettings {
  double tolerance = 1e-6;  ///< of the gaps, over the mean radius; > 0
  /// Of each contact's impulse, over the impulses at work on its particles in the step; > 0.
  double impulse_tolerance = 1e-10;
  int max_iterations = 10000;  ///< of a step, >= 1: products with W, sweeps, or factorisations
};

}  // namespace viscontact::particles
