// Newton's method on the set of active contacts (active_set_newton.hpp), in the scaled unknowns z.
#include "viscontact/particles/dual_problem/active_set_newton.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "viscontact/particles/dual_problem/free_set_factor.hpp"

namespace viscontact::particles {

template <int D>
SolverResult active_set_newton(ContactGraph<D>& graph, int max_iterations) {
  const auto start = graph.z;
  FreeSetFactor<D> factor(0);
  std::vector<double> displacements(graph.bodies() * D), gradient(graph.count()),
      correction(graph.count());
  std::vector<char> free(graph.count());  // 1 for the free contacts
  const auto compute_gradient = [&] {
    graph.to_bodies(graph.z, displacements);
    for (std::size_t c = 0; c < graph.count(); ++c)
      gradient[c] = graph.linear_term[c] + graph.to_contact(c, displacements.data());
  };
  compute_gradient();
  SolverResult solved;
  while (solved.iterations < max_iterations) {
    // Predict the free contacts. An active contact that closes by no more than its allowed residual
    // may carry load once its neighbours do: in a column at rest, only the lowest contact closes at
    // first.
    bool changed = false;
    for (std::size_t c = 0; c < graph.count(); ++c) {
      const double slack = 1 / graph.per_allowed[c];
      const char is_free = graph.z[c] - graph.bound[c] >= gradient[c] - slack ? 1 : 0;
      changed |= is_free != free[c];
      free[c] = is_free;
      if (is_free == 0) graph.z[c] = graph.bound[c];
    }
    if ((changed || !factor.exists()) && !factor.factorise(graph, free)) break;
    // Solve for their impulses.
    compute_gradient();
    factor.solve(gradient, correction);
    for (std::size_t c = 0; c < graph.count(); ++c) {
      graph.z[c] -= correction[c];
      // A contact that touches without load misses its bound only by rounding errors.
      const double slack = 1 / graph.per_allowed[c];
      if (graph.z[c] < graph.bound[c] && graph.z[c] > graph.bound[c] - slack)
        graph.z[c] = graph.bound[c];
    }
    compute_gradient();
    ++solved.iterations;
    solved.residual = 0;
    bool within_bounds = true;
    for (std::size_t c = 0; c < graph.count(); ++c) {
      within_bounds = within_bounds && graph.z[c] >= graph.bound[c];
      solved.residual = std::max(solved.residual, graph.residual(c, graph.z[c], gradient[c]));
    }
    if (within_bounds && solved.residual <= 1) return solved;
  }
  graph.z = start;
  solved.residual = std::numeric_limits<double>::infinity();
  return solved;
}

template SolverResult active_set_newton<2>(ContactGraph<2>&, int);
template SolverResult active_set_newton<3>(ContactGraph<3>&, int);

}  // namespace viscontact::particles
