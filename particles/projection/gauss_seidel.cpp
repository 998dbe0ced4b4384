// Projected Gauss-Seidel for the dual problem (5.4) of docs/physics.md, scaled as in
// contact_graph.hpp. Kept as the simplest method, to compare the others with.
#include <vector>

#include "viscontact/particles/projection/projection.hpp"

namespace viscontact::particles {

template <int D>
SolverResult gauss_seidel(ContactGraph<D>& graph, int max_iterations,
                          ActiveSetFactor<D>& /*factor*/) {
  const std::size_t count = graph.count();
  std::vector<double> y(graph.bodies() * D);
  SolverResult solved;
  // The displacements y of the bodies are updated contact by contact. They are computed again from
  // z before a solution is accepted, because the updates accumulate rounding errors.
  const auto gradient_of = [&](std::size_t c) {
    return graph.linear_term[c] + graph.to_contact(c, y.data());
  };
  const auto update_residuals = [&] {
    graph.to_bodies(graph.z, y);
    solved.residual = 0;
    for (std::size_t c = 0; c < count; ++c)
      solved.residual = std::max(solved.residual, graph.residual(c, graph.z[c], gradient_of(c)));
    return solved.residual <= 1;
  };
  if (update_residuals()) return solved;
  while (solved.iterations < max_iterations) {
    double largest = 0;
    const auto relax = [&](std::size_t c) {
      const double next = std::max(graph.bound[c], graph.z[c] - gradient_of(c));
      const double change = next - graph.z[c];
      largest = std::max(largest, graph.per_allowed[c] * std::abs(change));
      graph.z[c] = next;
      graph.add(c, change, y.data());
    };
    if (solved.iterations % 2 == 0)
      for (std::size_t c = 0; c < count; ++c) relax(c);
    else
      for (std::size_t c = count; c-- > 0;) relax(c);
    ++solved.iterations;
    // `largest` is the largest residual that the sweep found at a contact before it changed it.
    if ((largest <= 1 || solved.iterations == max_iterations) && update_residuals()) break;
  }
  return solved;
}

template SolverResult gauss_seidel<2>(ContactGraph<2>&, int, ActiveSetFactor<2>&);
template SolverResult gauss_seidel<3>(ContactGraph<3>&, int, ActiveSetFactor<3>&);

}  // namespace viscontact::particles
