// A sparse Cholesky factor of W between the active contacts.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "viscontact/particles/projection/contact_graph.hpp"

namespace viscontact::particles {

/// Factor of W (contact_graph.hpp) between chosen contacts, in the scaled unit of the graph. Chains
/// and packings at rest have as many active contacts as degrees of freedom, and W is then so
/// ill-conditioned that iterative methods take as many iterations as a chain has contacts. The
/// factor solves for the impulses between the active contacts at once.
template <int D>
class ActiveSetFactor {
 public:
  /// `epsilon` >= 0 is added to the diagonal of W, which is 1. Redundant contacts make W singular:
  /// it then bounds the impulses that they exert on each other.
  explicit ActiveSetFactor(double epsilon = 1e-10);
  ~ActiveSetFactor();

  /// Factorises W between the contacts c with `active[c]`. Returns false, and there is no factor, if
  /// it would fill so much that iterations are cheaper (packings of spheres do), or if W cannot be
  /// factorised. The order of elimination is kept for as long as the graph has as many contacts.
  bool factorise(const ContactGraph<D>& graph, const std::vector<char>& active);
  bool exists() const;

  /// solved = (W + epsilon)^-1 gradient between the contacts of the factor, 0 for all others.
  void solve(std::span<const double> gradient, std::span<double> solved) const;

  /// The factor as a preconditioner, symmetric and positive definite on the contacts that are free
  /// now: free contacts that were not active keep their gradient, contacts that are not free get 0. The graph is that of factorise(), or has more contacts at its end. Returns
  /// solved.gradient.
  double precondition(const ContactGraph<D>& graph, std::span<const double> gradient,
                      std::span<double> solved) const;

 private:
  struct Factor;
  double epsilon_;
  std::unique_ptr<Factor> factor_;
};

extern template class ActiveSetFactor<2>;
extern template class ActiveSetFactor<3>;

}  // namespace viscontact::particles
