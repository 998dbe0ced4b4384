// Accelerated projected gradient for the dual problem (5.4) of docs/physics.md, scaled as in
// contact_graph.hpp (Nesterov; O'Donoghue & Candes 2015; Mazhar et al. 2015).
#include <algorithm>
#include <vector>

#include "viscontact/common/system/block_results.hpp"
#include "viscontact/particles/projection/projection.hpp"

namespace viscontact::particles {
namespace {

/// Sums over the contacts in a step from y to x = P(y - g(y)/L), P the projection on the bounds.
struct Sums {
  double square = 0;  ///< |x - y|^2
  double uphill = 0;  ///< g(y).(x - previous x)
  Sums& operator+=(const Sums& other) {
    square += other.square;
    uphill += other.uphill;
    return *this;
  }
};

}  // namespace

template <int D>
SolverResult accelerated_gradient(ContactGraph<D>& graph, int max_iterations,
                                  ActiveSetFactor<D>& /*factor*/) {
  const std::size_t count = graph.count();
  const std::size_t numbers = graph.bodies() * D;
  auto& pool = graph.pool();
  // x: iterates. y: extrapolated points. g: gradients; they are linear in their points, so that one
  // product with W serves both x and y.
  std::vector<double> x = graph.z, y = graph.z, next(count), g_x(count), g_y(count), g_next(count);
  std::vector<double> bodies_y(numbers), bodies_x(numbers), bodies_next(numbers), step;
  const auto gradient = [&](const std::vector<double>& bodies, std::vector<double>& g,
                            const std::vector<double>& at) {
    return pool
        .template sum_of_blocks<MaximumOfBlocks>(
            count,
            [&](std::size_t begin, std::size_t end) {
              MaximumOfBlocks largest;
              for (std::size_t c = begin; c < end; ++c) {
                g[c] = graph.linear_term[c] + graph.to_contact(c, bodies.data());
                largest.value = std::max(largest.value, graph.residual(c, at[c], g[c]));
              }
              return largest;
            })
        .value;
  };
  graph.to_bodies(x, bodies_x);
  SolverResult solved;
  if (count == 0) return solved;
  solved.residual = gradient(bodies_x, g_x, x);
  g_y = g_x;
  bodies_y = bodies_x;
  double theta = 1;
  // L, an estimate of the largest eigenvalue of W, whose diagonal is 1.
  double steepness = 1;
  // L grows by the first factor whenever the objective curves more than L says. In each iteration
  // it shrinks by the second factor, so that the steps can become longer again.
  constexpr double kSteeper = 1.3, kFlatter = 0.99;
  while (solved.residual > 1 && solved.iterations < max_iterations) {
    Sums sums;
    for (;;) {
      sums = pool.template sum_of_blocks<Sums>(count, [&](std::size_t begin, std::size_t end) {
        Sums part;
        for (std::size_t c = begin; c < end; ++c) {
          next[c] = std::max(graph.bound[c], y[c] - g_y[c] / steepness);
          const double change = next[c] - y[c];
          part.square += change * change;
          part.uphill += g_y[c] * (next[c] - x[c]);
        }
        return part;
      });
      graph.to_bodies(next, bodies_next);
      ++solved.iterations;
      // (x - y)^T W (x - y), from the displacements, which are linear in x and y.
      step = bodies_y;
      const double curvature = graph.combine(bodies_next, -1, step);
      // The margin 1e-9 allows for rounding errors: a curvature equal to L must not count as
      // larger.
      if (curvature <= steepness * sums.square * (1 + 1e-9) || solved.iterations >= max_iterations)
        break;
      steepness *= kSteeper;
    }
    solved.residual = gradient(bodies_next, g_next, next);
    const double theta_next = (1 + std::sqrt(1 + 4 * theta * theta)) / 2;
    const bool restart = sums.uphill > 0;
    const double beta = restart ? 0 : (theta - 1) / theta_next;
    theta = restart ? 1 : theta_next;
    pool.for_blocks(count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        y[c] = next[c] + beta * (next[c] - x[c]);
        g_y[c] = g_next[c] + beta * (g_next[c] - g_x[c]);
      }
    });
    for (std::size_t k = 0; k < numbers; ++k)
      bodies_y[k] = bodies_next[k] + beta * (bodies_next[k] - bodies_x[k]);
    std::swap(x, next);
    std::swap(g_x, g_next);
    std::swap(bodies_x, bodies_next);
    steepness *= kFlatter;
  }
  graph.z = x;
  return solved;
}

template SolverResult accelerated_gradient<2>(ContactGraph<2>&, int, ActiveSetFactor<2>&);
template SolverResult accelerated_gradient<3>(ContactGraph<3>&, int, ActiveSetFactor<3>&);

}  // namespace viscontact::particles
