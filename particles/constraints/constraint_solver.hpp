// Solves the problem for the impulses of the contacts with friction, rigid bodies and links of a
// time step (constraint_problem.hpp). Lengths [L], masses [M] and times [T] are in any consistent
// units. Nothing is thrown: a problem that is not solved has SolverResult::residual > 1 or NaN.
// constraint_system.cpp, impacts/ and fluid/fluid_friction.cpp call it. One thread computes the
// solution, so that results do not depend on the number of threads; a change must keep that.
#pragma once

#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// What solve_constraints() found, besides the impulses.
template <int D>
struct ConstraintSolution {
  /// Number of iterations, and the largest residual of a block divided by its allowed residual [1].
  SolverResult result;
  std::vector<Motion<D>> motions;  ///< displacements [L] and turns [rad] of all units, in order
  std::vector<BlockResidual> residuals;  ///< residuals of all blocks, in order [L]
};

/// The method with which a solution with Coulomb's law begins.
enum class ConstraintStart {
  /// Gauss-Seidel sweeps, which are fast. If rows are redundant, so that several impulses solve the
  /// problem, the result depends on the order of the rows.
  kSweeps,
  /// A step of the proximal method from the guess in problem.impulses. If rows are redundant, the
  /// result is near the solution with the least squares of differences from the guess, unless it
  /// takes more than 2000 iterations.
  kLeastImpulses,
};

/// Improves problem.impulses [M L/T] until the residual of each block is allowed, or until about
/// `max_iterations` > 0 sweeps, factorisations and solutions with factors are done. Returns, and
/// leaves in problem.impulses, the iterate with the smallest residual. Each given_load may be
/// changed, too (below).
///
/// With Coulomb's law, Gauss-Seidel sweeps are made first, as long as they reduce the residual
/// fast, and steps of the proximal method (proximal_step.hpp) follow. If these are many, paths of
/// smoothed problems (coulomb_path.hpp) lead to points near a solution. A convex problem
/// (is_convex) is solved by interior points (interior_points.hpp), and proximal steps make the
/// solution accurate. If it is_rough, interior points stop early, and the residual may be several
/// times the allowed one. If contacts have given loads (FrictionBound::kGiven), these are replaced
/// by the loads of a first solution, and a second solution follows, unless problem.keeps_loads.
template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start = ConstraintStart::kSweeps);

/// Most iterations of a solution with given loads. Such solutions take 100 to 200 iterations, and
/// some of them 1000.
inline constexpr int kMostOfGivenLoads = 3000;

/// Bounds the friction of `problem` by given loads (FrictionBound::kGiven) in place of those of the
/// solution, and solves it in at most kMostOfGivenLoads iterations. The loads are those at the
/// present impulses, or, if `without_friction`, those of a solution without friction. The problem
/// keeps them. If it is not solved, SolverResult::residual is larger than 1.
template <int D>
ConstraintSolution<D> solve_with_given_loads(ConstraintProblem<D>& problem, bool without_friction);

/// For each block of `problem`, in order, its violation [L], >= 0, or [rad] of rows of angles, by
/// the motion that violates gaps and rigid links least: it has the least sum of v^2/w over the rows
/// of rigid links and the negative gaps, with the value v and the mobility w of a row. Tangential
/// rows and links with a compliance do not count.
template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
