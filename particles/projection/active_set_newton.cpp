// Newton's method on the set of active contacts (active_set_newton.hpp), in the scaled unknowns z.
#include "viscontact/particles/projection/active_set_newton.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace viscontact::particles {
namespace {

template <int D>
class Newton {
 public:
  explicit Newton(ContactGraph<D>& graph)
      : graph_(graph),
        factor_(0),
        displacements_(graph.bodies() * D),
        gradient_(graph.count()),
        correction_(graph.count()),
        active_(graph.count()) {
    compute_gradient();
  }

  /// Predicts the set of contacts with z free and solves for their impulses. Returns false if W has
  /// no factor.
  bool step() {
    bool changed = false;
    for (std::size_t c = 0; c < graph_.count(); ++c) {
      // A contact at its bound that closes by no more than its allowed residual may carry load once
      // its neighbours do. In a column at rest, for example, only the lowest contact closes at
      // first.
      const double slack = 1 / graph_.per_allowed[c];
      const char active = graph_.z[c] - graph_.bound[c] >= gradient_[c] - slack ? 1 : 0;
      changed |= active != active_[c];
      active_[c] = active;
      if (active == 0) graph_.z[c] = graph_.bound[c];
    }
    if ((changed || !factor_.exists()) && !factor_.factorise(graph_, active_)) return false;
    compute_gradient();
    factor_.solve(gradient_, correction_);
    for (std::size_t c = 0; c < graph_.count(); ++c) {
      graph_.z[c] -= correction_[c];
      // A contact that touches without load may miss its bound by rounding errors; it is set to the
      // bound.
      const double slack = 1 / graph_.per_allowed[c];
      if (graph_.z[c] < graph_.bound[c] && graph_.z[c] > graph_.bound[c] - slack)
        graph_.z[c] = graph_.bound[c];
    }
    compute_gradient();
    return true;
  }

  /// The largest residual; infinite if an impulse is below its bound.
  double residual() const {
    double largest = 0;
    for (std::size_t c = 0; c < graph_.count(); ++c) {
      if (!(graph_.z[c] >= graph_.bound[c])) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, graph_.residual(c, graph_.z[c], gradient_[c]));
    }
    return largest;
  }

 private:
  void compute_gradient() {
    graph_.to_bodies(graph_.z, displacements_);
    for (std::size_t c = 0; c < graph_.count(); ++c)
      gradient_[c] = graph_.linear_term[c] + graph_.to_contact(c, displacements_.data());
  }

  ContactGraph<D>& graph_;
  ActiveSetFactor<D> factor_;
  std::vector<double> displacements_;  // B z, displacements of the bodies [L]
  std::vector<double> gradient_, correction_;
  std::vector<char> active_;
};

}  // namespace

template <int D>
SolverResult active_set_newton(ContactGraph<D>& graph, int max_iterations) {
  const auto start = graph.z;
  Newton<D> newton(graph);
  SolverResult solved{0, std::numeric_limits<double>::infinity()};
  while (solved.iterations < max_iterations && newton.step()) {
    ++solved.iterations;
    solved.residual = newton.residual();
    if (solved.residual <= 1) return solved;
  }
  graph.z = start;
  solved.residual = std::numeric_limits<double>::infinity();
  return solved;
}

template SolverResult active_set_newton<2>(ContactGraph<2>&, int);
template SolverResult active_set_newton<3>(ContactGraph<3>&, int);

}  // namespace viscontact::particles
