// Solves the constraints of a step with friction (constraint_problem.hpp). Lengths, masses and
// times are in the units of the case. constraint_system.hpp, impacts/ and
// fluid_friction.cpp call it; nothing is
// thrown. The results do not depend on the number of threads, because one thread computes them.
#pragma once

#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// What solve_constraints() found, besides the impulses.
template <int D>
struct ConstraintSolution {
  SolverResult result;                   ///< SolverResult::residual is divided by what is allowed
  std::vector<Motion<D>> motions;        ///< y of the units ([L], [rad])
  std::vector<BlockResidual> residuals;  ///< of the blocks [L]
};

/// How a solution begins.
enum class ConstraintStart {
  /// With sweeps, which are fast. Where rows are redundant, impulses depend on their order.
  kSweeps,
  /// With a step of the proximal method from the guess: where rows are redundant, the sum of the
  /// squares of the impulses' distances from the guess is near its minimum, whatever the order of
  /// the rows.
  kLeastImpulses,
};

/// Improves problem.impulses until the residual of each block is allowed, or until about
/// `max_iterations` sweeps, factorisations and solutions with factors are done.
///
/// Sweeps begin and go on as long as they gain. For Coulomb's law, steps of the proximal method
/// (proximal_step.hpp) follow, whose epsilon falls after a step that was solved easily and grows
/// after one that was not solved. A convex problem is solved by interior points
/// (interior_points.hpp), and proximal steps make the solution accurate. Given loads
/// (ConstraintBlock::given_load) are replaced by those of the solution, and another solution
/// follows, unless problem.keeps_loads. The solution returned is the best that was found.
template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start = ConstraintStart::kSweeps);

}  // namespace viscontact::particles
