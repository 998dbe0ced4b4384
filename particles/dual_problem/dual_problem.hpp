// The dual problem (5.4) of docs/physics.md of one time step, in scaled unknowns, and what its
// solvers ask of it. It is the same whatever resists the impulses: masses (MassDualProblem), or a
// fluid (FluidDualProblem and DenseDualProblem in fluid/contact_problem.cpp). Lengths, masses and
// times are in the units of the case. Nothing is thrown. A change must keep gamma exact at its
// bound. Used by active_set_newton.hpp, mass_dual_problem.hpp and mprgp.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/particles/contact/contact.hpp"

namespace viscontact::particles {

/// How the solution of a dual problem ended.
struct SolverResult {
  int iterations = 0;  ///< number of iterations done, >= 0
  /// Largest DualProblem::residual. All contacts have converged if it is at most 1.
  double residual = 0;
};

/// The dual problem in impulses p = h lambda, where h is the length of the step and lambda are the
/// forces of the contacts. Without contact, particles move by h u*, and impulses add the mobility S
/// times G^T p, where G v is the velocity at which gaps open. D are the gaps at the beginning of
/// the step, and gamma^n the lower bounds of the impulses. The problem is
///
///     minimise  1/2 p^T W p + b^T p  over  p_ij >= gamma_ij^n,
///     W = G S G^T,   b = D + h G u*;   the gradient W p + b is D + h G v.
///
/// If gamma_ij^n = 0, the solution has p_ij >= 0 and D_ij + h G_ij v >= 0, and one of them is 0. If
/// gamma_ij^n < 0, a pull of at most -gamma_ij^n keeps D_ij + h G_ij v = 0. If more would be
/// needed, the pair separates within the step. All contacts are decided together.
///
/// The problem is scaled so that W has about the diagonal 1. With w = Contact::w, the unknowns are
/// z = sqrt(w) p, and the gradient of contact c is divided by sqrt(w).
class DualProblem {
 public:
  std::vector<double> z;            ///< scaled impulses z = sqrt(w) p
  std::vector<double> bound;        ///< lower bound of z: sqrt(w) gamma^n
  std::vector<double> linear_term;  ///< b/sqrt(w): the gradient at z = 0
  std::vector<double> scale;        ///< sqrt(w)
  std::vector<double> per_allowed;  ///< `scale` divided by the allowed residual of the contact

  /// Number of contacts.
  std::size_t count() const { return z.size(); }
  /// True if z_c is above its bound.
  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// Residual |min(D + h G v, w (p - gamma^n))| of contact c, divided by the residual that is
  /// allowed for it, for impulse z_c and gradient g_c. The contact has converged if this is at most
  /// 1.
  double residual(std::size_t c, double z_c, double gradient) const {
    return per_allowed[c] * contact_residual(gradient, z_c - bound[c]);
  }

  /// h lambda of contact c [M L/T]. A contact at its bound returns exactly gamma, so that no
  /// rounding error of z/scale remains in the new gamma.
  double impulse(std::size_t c) const { return z[c] == bound[c] ? lowest_[c] : z[c] / scale[c]; }

 protected:
  /// Makes room for this number of contacts, each of which set() must set.
  explicit DualProblem(std::size_t contacts)
      : z(contacts),
        bound(contacts),
        linear_term(contacts),
        scale(contacts),
        per_allowed(contacts),
        lowest_(contacts) {}

  /// Sets contact number `c`, which has w > 0 and `allowed` > 0; `free_gap` is D + h G u* [L].
  template <int D>
  void set(std::size_t c, const Contact<D>& contact, double free_gap) {
    const double root = std::sqrt(contact.w);
    scale[c] = root;
    per_allowed[c] = root / contact.allowed;
    z[c] = std::max(contact.impulse, contact.lowest) * root;
    bound[c] = contact.lowest * root;
    lowest_[c] = contact.lowest;
    linear_term[c] = free_gap / root;
  }

 private:
  std::vector<double> lowest_;  // Contact::lowest, as given
};

/// A dual problem whose products with W are known. A vector y = B z, of displacement_count()
/// numbers, holds what the scaled impulses z cause, in a form of the problem's own that is linear
/// in z:
///
/// - to_bodies(z, y) computes y = B z and returns z^T W z,
/// - combine(y, factor, into) replaces `into` by y + factor * into and returns z^T W z of the sum,
/// - to_contact(c, y) is (W z)_c.
template <class Problem>
concept SolvableDualProblem = std::derived_from<Problem, DualProblem> &&
    requires(Problem& problem, std::span<const double> z, std::span<double> y, std::size_t c) {
  { problem.displacement_count() } -> std::convertible_to<std::size_t>;
  { problem.to_bodies(z, y) } -> std::convertible_to<double>;
  { problem.combine(z, 1.0, y) } -> std::convertible_to<double>;
  { problem.to_contact(c, y.data()) } -> std::convertible_to<double>;
  { problem.pool() } -> std::convertible_to<ThreadPool&>;
};

}  // namespace viscontact::particles
