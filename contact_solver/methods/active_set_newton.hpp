// Newton's method for the dual problem (5.4), docs/physics.md, in the scaled unknowns of
// dual_problem.hpp.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <limits>
#include <vector>

#include "viscontact/common/index.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"

namespace viscontact::contact_solver {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active
/// set strategy as a semismooth Newton method"). With g the gradient, contacts are active if z - g
/// is smaller than the bound by more than the allowed residual. Their z are set to the bounds, and
/// a factor of W gives the z of all others at which their g is 0. A chain of contacts of any length
/// takes a few iterations. `factor` has the interface of FreeSetFactor (mass_dual_problem.hpp).
///
/// The method converges fast near the solution and may cycle far from it. If it has not converged
/// after `max_iterations`, or factorise() returns false, problem.z is as before, and the returned
/// residual is infinite. Otherwise it is at most 1.
template <SolvableDualProblem Problem, class Factor>
SolverResult active_set_newton(Problem& problem, Factor& factor, int max_iterations) {
  assert(!factor.exists());
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
    // A contact at its bound whose gap stays open by no more than its allowed residual counts as
    // free, too, because it may bear load once its neighbours do. In a column at rest without
    // impulses, for example, at first only the lowest contact closes.
    bool changed = false;
    for (std::size_t c = 0; c < problem.count(); ++c) {
      const double slack = 1 / problem.per_allowed[c];
      const char is_free = problem.z[c] - problem.bound[c] >= gradient[c] - slack ? 1 : 0;
      changed |= is_free != free[c];
      free[c] = is_free;
      if (is_free == 0) problem.z[c] = problem.bound[c];
    }
    if ((changed || !factor.exists()) && !factor.factorise(problem, free)) break;
    compute_gradient();
    factor.solve(gradient, correction);
    for (std::size_t c = 0; c < problem.count(); ++c) {
      problem.z[c] -= correction[c];
      // A contact that touches without load is below its bound only by a rounding error.
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
      solved.residual =
          largest_or_nan(solved.residual, problem.residual(c, problem.z[c], gradient[c]));
    }
    if (within_bounds && solved.residual <= 1) return solved;
  }
  problem.z = start;
  solved.residual = std::numeric_limits<double>::infinity();
  return solved;
}

}  // namespace viscontact::contact_solver
