// A ConstraintProblem is handed to the table of strategies of its kind.
#include "viscontact/contact_solver/constraint_solver.hpp"

#include <algorithm>
#include <cassert>

#include "viscontact/contact_solver/convex_ladder.hpp"
#include "viscontact/contact_solver/coulomb_ladder.hpp"

namespace viscontact::contact_solver {

template <int D>
ConstraintSolution<D> solve_constraints(ConstraintProblem<D>& problem, int max_iterations,
                                        ConstraintStart start) {
  assert(problem.impulses.size() == problem.rows.size());
  if (problem.is_convex) return ConvexLadder<D>(problem, max_iterations, start).solve();
  return CoulombLadder<D>(problem, max_iterations, start).solve();
}

template <int D>
ConstraintSolution<D> solve_with_given_loads(ConstraintProblem<D>& problem, bool without_friction,
                                             ConstraintStart start) {
  give_loads(problem);
  if (without_friction) {
    for (auto& block : problem.blocks) block.given_load = 0;
    std::ranges::fill(problem.impulses, 0.0);
    problem.keeps_loads = problem.is_near = false;
  }
  auto solution = solve_constraints(problem, kMostOfGivenLoads, start);
  problem.keeps_loads = true;
  return solution;
}

template ConstraintSolution<2> solve_constraints<2>(ConstraintProblem<2>&, int, ConstraintStart);
template ConstraintSolution<3> solve_constraints<3>(ConstraintProblem<3>&, int, ConstraintStart);
template ConstraintSolution<2> solve_with_given_loads<2>(ConstraintProblem<2>&, bool,
                                                         ConstraintStart);
template ConstraintSolution<3> solve_with_given_loads<3>(ConstraintProblem<3>&, bool,
                                                         ConstraintStart);

}  // namespace viscontact::contact_solver
