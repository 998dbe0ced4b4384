// Solves the dual problem (5.4) of docs/physics.md for a time step. Impulses and residuals are
// scaled as dual_problem.hpp says. projection/ and impacts/ use it. Nothing is thrown: the result
// has the residual. Results must not depend on the number of threads.
#pragma once

#include "viscontact/particles/dual_problem/free_set_factor.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// Solves the dual problem by projected conjugate gradients (mprgp.hpp), preconditioned by sweeps
/// of symmetric Gauss-Seidel or, if these take long and it is cheap, by a sparse factor of W
/// (free_set_factor.hpp). Newton's method (active_set_newton.hpp) solves chains of contacts, and is
/// tried if the other methods take many iterations.
///
/// Improves problem.z, which begins as a guess, until all residuals are at most 1 or
/// `max_iterations` are done. Redundant contacts have impulses of which the velocities determine
/// only sums; their values depend on the guess. `factor` belongs to earlier solves of the same
/// step, whose problem may have had fewer contacts. This function uses the factor and may replace
/// it.
template <int D>
SolverResult solve_dual_problem(MassDualProblem<D>& problem, int max_iterations,
                                FreeSetFactor<D>& factor);

}  // namespace viscontact::particles
