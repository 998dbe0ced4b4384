// Solves the constraints of a step with friction (constraint_problem.hpp). Units are those of the
// case. The results do not depend on the number of threads, because one thread computes them.
#pragma once

#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/dual_problem/dual_solver.hpp"

namespace viscontact::particles {

template <int D>
struct ConstraintSolution {
  SolverResult result;  ///< SolverResult::residual is divided by what is allowed
  std::vector<Motion<D>> motions;
  std::vector<BlockResidual> residuals;
};

/// Improves problem.impulses until the residual of each block is allowed, or until about
/// `max_iterations` sweeps, factorisations and solutions with factors are done.
///
/// Some sweeps (contact_sweeps.hpp) begin. Steps of the proximal method (proximal_step.hpp) follow,
/// and Anderson's acceleration (anderson.hpp) extrapolates from their impulses. If a number of
/// steps gains little, epsilon is reduced; if a step fails, sweeps follow again. The solution
/// returned is the best that was found.
template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations);

}  // namespace viscontact::particles
