// Solves the problem for the impulses of the contacts with friction and of the links of a time
// step, on particles and rigid bodies (constraint_problem.hpp). Lengths [L], masses [M] and times
// [T] are in any consistent units. Nothing is checked or thrown: a problem that is not solved has a
// SolverResult::residual that is > 1 or NaN. constraint_system.cpp, impacts/ and
// fluid/fluid_friction.cpp call it. One thread computes the solution, so that results do not depend
// on the number of threads; a change must keep that.
#pragma once

#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"
#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// The result of solve_constraints() besides the impulses, which problem.impulses has.
template <int D>
struct ConstraintSolution {
  /// Number of iterations, >= 0, and the largest residual of a block divided by its allowed
  /// residual [1]: at most 1 if the problem is solved.
  SolverResult result;
  std::vector<Motion<D>> motions;  ///< displacements [L] and turns [rad] of all units, in order
  std::vector<BlockResidual> residuals;  ///< residuals of all blocks, in order [L], >= 0
};

/// The method with which a solution with Coulomb's law begins. Rows are redundant if several sets
/// of impulses solve the problem.
enum class ConstraintStart {
  /// It begins with Gauss-Seidel sweeps, which are fast. If rows are redundant, the result depends
  /// on the order of the rows.
  kSweeps,
  /// It begins with a step of the proximal method from the guess in problem.impulses. If rows are
  /// redundant, the result is near the solution with the least sum of squares of differences from
  /// the guess, unless the solution takes more than 2000 iterations.
  kLeastImpulses,
};

/// Improves problem.impulses [M L/T] until the residual of each block is at most its allowed one,
/// or until about `max_iterations` > 0 iterations are done: sweeps, factorisations and solutions
/// with factors. Returns the iterate with the smallest residual and leaves it in problem.impulses.
/// It may also change the given_load of each block (below).
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

/// Most iterations of solve_with_given_loads(). It is a free choice > 0: most such solutions take
/// 100 to 200 iterations, and some of them 1000.
inline constexpr int kMostOfGivenLoads = 3000;

/// Bounds the friction of `problem` by given loads (FrictionBound::kGiven) in place of the loads of
/// the solution, and solves the problem in at most kMostOfGivenLoads iterations. The given loads
/// are those at the present impulses, or, if `without_friction`, those of a solution without
/// friction. They stay in the problem. If it is not solved, SolverResult::residual is > 1 or NaN.
template <int D>
ConstraintSolution<D> solve_with_given_loads(ConstraintProblem<D>& problem, bool without_friction);

/// For each block of `problem`, in order, its violation [L], >= 0, or [rad] if its rows are angles,
/// by the motion of the units that violates gaps and rigid links least. This motion has the least
/// sum of v^2/w over the rows of rigid links and the negative gaps, with the value v and the
/// mobility w of a row. Tangential rows do not count, and the violation of a link with a compliance
/// is 0.
template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem);

}  // namespace viscontact::particles
