// Solves a ConstraintProblem.
#pragma once

#include <vector>

#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

namespace viscontact::contact_solver {

template <int D>
struct ConstraintSolution {
  /// The number of iterations, and the largest residual of a block over its allowed one [1]: at
  /// most 1 if the problem is solved, else > 1 or NaN.
  SolverResult result;
  std::vector<Motion<D>> motions;        ///< of all units [L, rad]
  std::vector<BlockResidual> residuals;  ///< of all blocks [L]
};

/// How a solution with Coulomb's law begins.
enum class ConstraintStart {
  /// With fast Gauss-Seidel sweeps. If rows are redundant, the result depends on the order of the
  /// rows.
  kSweeps,
  /// With a proximal step. If rows are redundant, the result is near the solution with the least
  /// sum of squares of differences from the guess, unless it takes more than 2000 iterations.
  kLeastImpulses,
  /// With accelerated sweeps, if all blocks are contacts of round particles, otherwise as kSweeps.
  /// They are fast where residuals of 1e-3 of the motions are allowed and the guess is good. If
  /// rows are redundant, the result depends on the guess.
  kAcceleratedSweeps,
};

/// Improves problem.impulses [M L/T] until the residual of each block is allowed, or until about
/// `max_iterations` iterations are done, and returns the iterate with the smallest residual. The
/// tables of CoulombLadder and ConvexLadder say which method runs when; SolverResult::stages lists
/// those that ran, whose iterations add up to SolverResult::iterations. In a convex problem that
/// is_rough, interior points stop early, and the residual may be several times the allowed one.
/// Loads of FrictionBound::kGiven are replaced by those of a first solution, unless
/// problem.keeps_loads. One thread computes all, so that results do not depend on their number.
template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start = ConstraintStart::kSweeps);

/// Most iterations of solve_with_given_loads(). Most such solutions take 100 to 200, some 1000.
inline constexpr int kMostOfGivenLoads = 3000;

/// Solves the problem with FrictionBound::kGiven in at most kMostOfGivenLoads iterations. The given
/// loads are those at the present impulses, or, if `without_friction`, those of a solution without
/// friction. They stay in the problem.
template <int D>
ConstraintSolution<D> solve_with_given_loads(ConstraintProblem<D>& problem, bool without_friction,
                                             ConstraintStart start = ConstraintStart::kSweeps);

/// For each block its violation [L], or [rad] of angles, by the motion of the units with the least
/// sum of v^2/w over the rows of rigid links and the negative gaps, with the value v and the
/// mobility w of a row. Tangential rows do not count, and a link with a compliance has 0.
template <int D>
std::vector<double> least_violations(const ConstraintProblem<D>& problem);

}  // namespace viscontact::contact_solver
