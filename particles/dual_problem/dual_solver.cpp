// Chooses between conjugate gradients, a sparse factor and Newton's method for the dual problem
// (dual_solver.hpp). The constants change how long a solution takes, and the results within the
// tolerances.
#include "viscontact/particles/dual_problem/dual_solver.hpp"

#include <algorithm>
#include <cstddef>

#include "viscontact/particles/dual_problem/active_set_newton.hpp"
#include "viscontact/particles/dual_problem/mprgp.hpp"
#include "viscontact/particles/dual_problem/preconditioner.hpp"

namespace viscontact::particles {

template <int D>
SolverResult solve_dual_problem(ContactGraph<D>& graph, int max_iterations,
                                FreeSetFactor<D>& factor) {
  Mprgp mprgp(graph, Preconditioner<D>(graph, factor));
  SolverResult solved;
  // Numbers of iterations with the same free contacts after which a (new) factor is worth its cost.
  // If a factor exists, a few iterations without convergence show that the free contacts have
  // changed. The rough solution of a step changes them often and seldom needs a factor. For the
  // accurate solution, 10 instead of 30 saves 7 % of the time on bench/box2d.cpp.
  constexpr int kPatienceWithFactor = 10;
  const int patience_without = graph.is_rough ? 40 : 10;
  // Newton's method comes first where contacts form almost no cycles (chains, columns), unless the
  // guess is already exact, because in a long chain even small residuals mean large errors of the
  // impulses. In packings it may cycle, so that it is tried only after many iterations.
  constexpr int kLongPatience = 300, kNewtonIterations = 10;
  constexpr std::size_t kLongChain = 6;  // shorter chains take fewer sweeps than a factor costs
  const bool has_chains =
      graph.largest_island > kLongChain && graph.count() < graph.bodies() + graph.bodies() / 8;
  // A guess with a residual of at most this fraction of the allowed residual counts as exact.
  constexpr double kNearlySolved = 1e-4;
  if (has_chains && mprgp.residual() > kNearlySolved) {
    solved = active_set_newton(graph, kNewtonIterations);
    if (solved.residual <= 1) return solved;
    mprgp.refresh();
  }
  int next_newton = kLongPatience;
  bool fresh = true, factorisable = true;
  for (;;) {
    solved.residual = mprgp.residual();
    if (solved.residual <= 1 || solved.iterations >= max_iterations) {
      if (fresh) return solved;
      mprgp.refresh();  // the updated gradient has accumulated rounding errors
      fresh = true;
    } else if (solved.iterations >= next_newton) {
      solved.iterations += active_set_newton(graph, kNewtonIterations).iterations;
      mprgp.drop_regularisation();
      next_newton = std::max(kLongPatience, 2 * solved.iterations);
      fresh = true;
    } else {
      const int patience = factor.exists() ? kPatienceWithFactor : patience_without;
      if (factorisable && mprgp.steps_between_same() >= patience) factorisable = mprgp.factorise();
      solved.iterations += mprgp.step();
      fresh = false;
    }
  }
}

template SolverResult solve_dual_problem<2>(ContactGraph<2>&, int, FreeSetFactor<2>&);
template SolverResult solve_dual_problem<3>(ContactGraph<3>&, int, FreeSetFactor<3>&);

}  // namespace viscontact::particles
