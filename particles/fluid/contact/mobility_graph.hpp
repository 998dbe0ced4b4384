// The contact problem of a step in a fluid as the solver of the projection sees it
// (dual_problem/mprgp.hpp), with one question to the fluid for each product with W. Units are those
// of the case.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/fluid/contact/contact_problem.hpp"

namespace viscontact::particles {

/// The dual problem of ContactProblem in scaled unknowns z = sqrt(w) p, as ContactGraph scales it.
/// A vector y = B z holds the displacements S G^T p that the impulses p cause, S the mobility, and
/// after them the impulses G^T p on the particles. Their product is z^T W z.
class MobilityGraph {
 public:
  /// `contacts` have w > 0. `b` is the gradient at p = 0 [L], `allowed` > 0 are the largest
  /// residuals [L]. `motions` is the number of components of the motions of all particles.
  MobilityGraph(std::span<const FluidContact> contacts, std::span<const double> b,
                std::span<const double> allowed, std::size_t motions, const Mobility& mobility,
                const MotionLayout& layout);

  /// Number of contacts.
  std::size_t count() const { return contacts_.size(); }
  /// Number of numbers in a vector y = B z: motions of the particles, and impulses on them.
  std::size_t displacement_count() const { return 2 * motions_; }
  /// One thread, because the solver of the fluid does most of the work.
  ThreadPool& pool() const { return pool_; }

  std::vector<double> z,  ///< scaled impulses z = sqrt(w) p; see ContactGraph
      bound,              ///< lower bounds of z
      linear_term,        ///< the gradient at z = 0
      scale,              ///< sqrt(w) of each contact
      per_allowed;        ///< see ContactGraph

  /// Computes y = B z by one product with the mobility. Returns z^T W z.
  double to_bodies(std::span<const double> values, std::span<double> y);

  /// Replaces `into` by y + factor * into. Returns z^T W z of the sum.
  double combine(std::span<const double> y, double factor, std::span<double> into) const;

  /// (W z)_c for y = B z.
  double to_contact(std::size_t c, const double* y) const {
    return opening(contacts_[c], y, layout_) / scale[c];
  }

  /// True if z_c is above its bound.
  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// h lambda of contact c [M L/T].
  double impulse(std::size_t c) const {
    return z[c] == bound[c] ? contacts_[c].gamma : z[c] / scale[c];
  }
  int products() const { return products_; }  ///< number of calls of to_bodies()

 private:
  std::span<const FluidContact> contacts_;
  std::size_t motions_;
  const Mobility& mobility_;
  MotionLayout layout_;
  int products_ = 0;
  mutable ThreadPool pool_{1};
};

/// Conjugate gradients on the free contacts without a further preconditioner: W has about the
/// diagonal 1 already.
class IdentityPreconditioner {
 public:
  /// Tells Mprgp to use apply() alone.
  static constexpr bool kMaySweep = false;
  /// `graph` must outlive the object.
  explicit IdentityPreconditioner(MobilityGraph& graph) : graph_(&graph) {}

  /// Sets swept to the gradient of the free contacts, and y = B swept. Returns swept.gradient.
  double apply(std::span<const double> gradient, std::vector<double>& swept,
               std::vector<double>& y) const;

 private:
  MobilityGraph* graph_;
};

}  // namespace viscontact::particles
