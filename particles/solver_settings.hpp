// When the projection of a time step has converged.
#pragma once

namespace viscontact::particles {

/// Tolerances have no dimension; docs/particles.md says how each is measured.
struct SolverSettings {
  /// Tolerance of the gaps, divided by the mean radius; > 0.
  double tolerance = 1e-6;
  /// Tolerance of each contact's impulse, divided by the impulses at work on its particles; > 0.
  double impulse_tolerance = 1e-10;
  /// Largest number of iterations in a step, >= 1. An iteration is a product with W, a sweep, or a
  /// factorisation.
  int max_iterations = 10000;
};

}  // namespace viscontact::particles
