// Newton's method on the set of active contacts, for the dual problem (5.4) of docs/physics.md,
// scaled as in dual_problem.hpp. dual_solver.cpp and fluid/contact_problem.cpp use it; nothing is
// thrown. A change must keep that a call without a solution leaves z as it was.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "viscontact/particles/dual_problem/dual_problem.hpp"

namespace viscontact::particles {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active
/// set strategy as a semismooth Newton method"). With g the gradient, each iteration takes the
/// contacts with z - g < bound as active, except those that meet this condition by no more than
/// their allowed residual. Active contacts are set to their bounds. A factor of W gives the
/// impulses at which g = 0 at all others, the free contacts. The method ends when all residuals are
/// allowed. A chain of any length takes a few iterations.
///
/// `factor` is like FreeSetFactor: factorise(problem, free) makes a factor of W between the
/// contacts with free[c] != 0, and solve() applies it. It belongs to no other solution.
///
/// The method converges fast near the solution and may cycle far from it. It stops after
/// `max_iterations` factorisations. If it has not converged then, or if W is singular or has no
/// cheap factor, problem.z is what it was before the call, and the returned residual is infinite.
template <SolvableDualProblem Problem, class Factor>
SolverResult active_set_newton(Problem& problem, Factor& factor, int max_iterations) {
  const auto start = problem.z;
  std::vector<double> displacements(problem.displacement_count()), gradient(problem.count()),
      correction(problem.count());
  std::vector<char> free(problem.count());  // 1 for the free contacts
  const auto compute_gradient = [&] {
    problem.to_bodies(problem.z, displacements);
    for (std::size_t c = 0; c < problem.count(); ++c)
      gradient[c] = problem.linear_term[c] + problem.to_contact(c, displacements.data());
  };
  compute_gradient();
  SolverResult solved;
  while (solved.iterations < max_iterations) {
    // Predict the free contacts. An active contact that closes by no more than its allowed residual
    // may carry load once its neighbours do: in a column at rest, only the lowest contact closes at
    // first.
    bool changed = false;
    for (std::size_t c = 0; c < problem.count(); ++c) {
      const double slack = 1 / problem.per_allowed[c];
      const char is_free = problem.z[c] - problem.bound[c] >= gradient[c] - slack ? 1 : 0;
      changed |= is_free != free[c];
      free[c] = is_free;
      if (is_free == 0) problem.z[c] = problem.bound[c];
    }
    if ((changed || !factor.exists()) && !factor.factorise(problem, free)) break;
    // Solve for their impulses.
    compute_gradient();
    factor.solve(gradient, correction);
    for (std::size_t c = 0; c < problem.count(); ++c) {
      problem.z[c] -= correction[c];
      // A contact that touches without load misses its bound only by rounding errors.
      const double slack = 1 / problem.per_allowed[c];
      if (problem.z[c] < problem.bound[c] && problem.z[c] > problem.bound[c] - slack)
        problem.z[c] = problem.bound[c];
    }
    compute_gradient();
    ++solved.iterations;
    solved.residual = 0;
    bool within_bounds = true;
    for (std::size_t c = 0; c < problem.count(); ++c) {
      within_bounds = within_bounds && problem.z[c] >= problem.bound[c];
      solved.residual = std::max(solved.residual, problem.residual(c, problem.z[c], gradient[c]));
    }
    if (within_bounds && solved.residual <= 1) return solved;
  }
  problem.z = start;
  solved.residual = std::numeric_limits<double>::infinity();
  return solved;
}

}  // namespace viscontact::particles
