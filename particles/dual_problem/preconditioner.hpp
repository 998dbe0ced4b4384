// The preconditioner of conjugate gradients for the dual problem (5.4) of docs/physics.md, scaled
// as in contact_graph.hpp. A change must keep the order of all sums.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/dual_problem/contact_graph.hpp"
#include "viscontact/particles/dual_problem/free_set_factor.hpp"

namespace viscontact::particles {

/// A factor of W between the free contacts, if there is one, and otherwise a sweep of symmetric
/// Gauss-Seidel over them: (I + L^T)^-1 (I + L)^-1, L the strictly lower triangle of W between the
/// free contacts of a block. Each block of the thread pool is swept by itself, so that the blocks
/// can be swept at once. The number of blocks does not depend on the number of threads.
template <int D>
class Preconditioner {
 public:
  /// Tells Mprgp that sweeps() may be true.
  static constexpr bool kMaySweep = true;

  /// Both arguments must outlive the object.
  Preconditioner(const ContactGraph<D>& graph, FreeSetFactor<D>& factor)
      : graph_(graph), factor_(factor), half_swept_(graph.count()) {}

  /// True if there is no factor.
  bool sweeps() const { return !factor_.exists(); }

  /// Makes a factor of W between the contacts that are free now. Returns false if the factor would
  /// have too many entries or cannot be computed.
  bool factorise() {
    std::vector<char> free(graph_.count());
    for (std::size_t c = 0; c < graph_.count(); ++c) free[c] = graph_.is_free(c) ? 1 : 0;
    return factor_.factorise(graph_, free);
  }

  /// The forward half of the sweep, half_swept = (I + L)^-1 gradient, which must precede apply().
  void sweep_forward(std::span<const double> gradient) {
    graph_.pool().for_blocks(graph_.count(), [&](std::size_t begin, std::size_t end) {
      auto y = graph_.block_bodies(begin);
      for (std::size_t c = begin; c < end; ++c)
        sweep_forward(c, gradient[c], graph_.is_free(c), y.data());
    });
  }

  /// The same for one contact; `y` are the displacements of the block's bodies up to this contact.
  void sweep_forward(std::size_t c, double gradient, bool is_free, double* y) {
    const double t = is_free ? gradient - graph_.to_contact_in_block(c, y) : 0.0;
    half_swept_[c] = t;
    graph_.add_in_block(c, t, y);
  }

  /// Sets swept to the preconditioner times the gradient, and y = B swept. Returns swept.gradient.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const {
    const double product =
        sweeps() ? sweep_back(gradient, swept, y) : factor_.precondition(graph_, gradient, swept);
    if (!sweeps() || graph_.count() > ThreadPool::kBlock) graph_.to_bodies(swept, y);
    return product;
  }

 private:
  /// The backward half of the sweep: swept = (I + L^T)^-1 half_swept. Returns swept.gradient.
  double sweep_back(std::span<const double> gradient, std::vector<double>& swept,
                    std::vector<double>& y) const {
    return graph_.pool().template sum_of_blocks<double>(graph_.count(), [&](std::size_t begin,
                                                                            std::size_t end) {
      double product = 0;
      auto sums = graph_.block_bodies(begin);
      for (std::size_t c = end; c-- > begin;) {
        const double s =
            graph_.is_free(c) ? half_swept_[c] - graph_.to_contact_in_block(c, sums.data()) : 0.0;
        swept[c] = s;
        product += s * gradient[c];
        graph_.add_in_block(c, s, sums.data());
      }
      // With a single block, B swept is known already.
      if (graph_.count() <= ThreadPool::kBlock) std::swap(y, sums);
      return product;
    });
  }

  const ContactGraph<D>& graph_;
  FreeSetFactor<D>& factor_;
  std::vector<double> half_swept_;
};

}  // namespace viscontact::particles
