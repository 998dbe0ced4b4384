// Newton's method for the dual problem of a time step: it finds scaled impulses z >= bound of the
// contacts with a gradient W z + linear_term >= 0, such that one of the two is an equality for each
// contact. With the impulse p [M L/T] and the mobility w [T/M] of a contact, z is w^(1/2) p, and
// the gradient is its gap [L] divided by w^(1/2); W is a matrix without dimension
// (dual_problem.hpp). dual_solver.cpp and fluid/contact_problem.cpp use the method. Nothing is
// checked or thrown. A change must keep that a call that finds no solution leaves z as it was.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "viscontact/particles/dual_problem/dual_problem.hpp"
#include "viscontact/particles/vector.hpp"

namespace viscontact::particles {

/// The primal-dual active set method (Hintermueller, Ito & Kunisch 2003, "The primal-dual active
/// set strategy as a semismooth Newton method"). With g the gradient, each iteration calls those
/// contacts active for which z - g is smaller than the bound by more than the allowed residual. It
/// sets z of the active contacts to their bounds. A factor of W then gives the z of all other
/// contacts, the free ones, at which their g is 0. The method ends when no residual is larger than
/// allowed. A chain of contacts of any length takes a few iterations.
///
/// `factor` has the interface of FreeSetFactor (mass_dual_problem.hpp): factorise(problem, free)
/// makes a factor of W between the contacts c with free[c] != 0 and returns true, or returns false;
/// solve(gradient, correction) applies the factor; and exists() says whether there is a factor. At
/// the call of active_set_newton() there must be none.
///
/// The method converges fast near the solution and may cycle far from it. It stops after
/// `max_iterations` solutions with the factor. If it has not converged then, or if factorise()
/// returns false, problem.z is what it was before the call, and the returned residual is infinite.
/// Otherwise the returned residual is at most 1.
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
    // Decide which contacts are free. A contact at its bound whose gap stays open by no more than
    // its allowed residual counts as free, too, because it may bear load once its neighbours do. In
    // a column at rest without impulses, for example, at first only the lowest contact closes.
    bool changed = false;
    for (std::size_t c = 0; c < problem.count(); ++c) {
      const double slack = 1 / problem.per_allowed[c];
      const char is_free = problem.z[c] - problem.bound[c] >= gradient[c] - slack ? 1 : 0;
      changed |= is_free != free[c];
      free[c] = is_free;
      if (is_free == 0) problem.z[c] = problem.bound[c];
    }
    if ((changed || !factor.exists()) && !factor.factorise(problem, free)) break;
    // Solve for the impulses of the free contacts.
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

}  // namespace viscontact::particles
