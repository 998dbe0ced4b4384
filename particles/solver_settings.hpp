// When the projection of a time step has converged: `[solver]` of a case of particles, whose values
// particles/case checks. projection/, constraints/ and fluid/ use it. A change of a default changes
// the results of every case that does not set it.
#pragma once

#include <algorithm>
#include <limits>

namespace viscontact::particles {

/// Tolerances have no dimension; docs/particles.md, "The projection", says how each is measured.
struct SolverSettings {
  /// Tolerance of the gaps, divided by the mean radius; > 0.
  double tolerance = 1e-6;
  /// Tolerance of each contact's impulse, divided by the impulses at work on its particles; > 0.
  double impulse_tolerance = 1e-10;
  /// Largest number of iterations in a step, >= 1. An iteration is a product with the matrix W of
  /// the dual problem, docs/physics.md (5.4), a sweep over the contacts, or a factorisation.
  int max_iterations = 10000;
};

/// Largest distance from the origin, and largest displacement in a step, that a particle may have
/// [L]. Beyond this distance the rounding errors of positions exceed `tolerance` (SolverSettings)
/// times `mean_radius` [L].
inline double largest_resolved_distance(double tolerance, double mean_radius) {
  // Squares of distances must be finite: 1e120 is far below 1e154, the root of the largest double.
  constexpr double kFinite = 1e120;
  return std::min(kFinite, tolerance * mean_radius / std::numeric_limits<double>::epsilon());
}

}  // namespace viscontact::particles
