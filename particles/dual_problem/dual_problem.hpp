// The problem for the impulses of the contacts in one time step (the dual problem (5.4) of
// docs/physics.md) in scaled unknowns, and the functions that its solvers call. The same problem
// describes particles whose masses resist their motion (MassDualProblem), and particles in a fluid
// (FluidDualProblem and DenseDualProblem in fluid/contact_problem.cpp). Lengths [L], masses [M] and
// times [T] are in any consistent units; in a fluid M stands for M/L. Nothing is checked or thrown.
// active_set_newton.hpp, mass_dual_problem.hpp, mprgp.hpp and fluid/contact_problem.cpp use it. A
// change must keep that an impulse at its bound has exactly the bits of the bound.
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
  /// Largest DualProblem::residual() of all contacts [1], >= 0; infinite if the method gave up. All
  /// contacts have converged if it is at most 1. NaN if a number of the problem is NaN.
  double residual = 0;
};

/// The unknowns are the impulses p [M L/T] of the contacts. Without them the particles have the
/// velocities u* and move by h u* [L] in the step of length h. Impulses change this displacement by
/// S G^T p. Here S [T/M] is the mobility (displacement per impulse), and G is the matrix with which
/// G v are the velocities at which the gaps open if the particles have the velocities v. D [L] are
/// the gaps at the beginning of the step, and gamma^n <= 0 [M L/T] the lower bounds of the
/// impulses: a film between two particles can give back at most the impulse -gamma^n that it has
/// absorbed. p_ij is the impulse of the contact of the particles i and j. The problem is
///
///     minimise  1/2 p^T W p + b^T p  over  p_ij >= gamma_ij^n,
///     W = G S G^T,   b = D + h G u*;   the gradient W p + b is D + h G v.
///
/// with the velocities v that the impulses p cause. For each contact ij, the solution has p_ij >=
/// gamma_ij^n and a gap D_ij + h G_ij v >= 0 at the end of the step, and one of the two is an
/// equality. If gamma_ij^n < 0, a pull of at most -gamma_ij^n thus keeps the gap at 0; if a larger
/// pull would be needed, the gap opens within the step.
///
/// The problem is scaled so that the diagonal of W is about 1. With w = Contact::w, the diagonal of
/// W or an estimate of it [T/M], the scaled impulses are z = sqrt(w) p, and the gradient of contact
/// c is divided by sqrt(w). Both have the dimension of sqrt(w) times an impulse.
class DualProblem {
 public:
  // The arrays have one number for each contact; c < count() is the number of a contact. The unit
  // of z, bound and linear_term is L (M/T)^(1/2).
  std::vector<double> z;            ///< scaled impulses z = sqrt(w) p
  std::vector<double> bound;        ///< lower bound of z: sqrt(w) gamma^n
  std::vector<double> linear_term;  ///< b/sqrt(w): the gradient at z = 0
  std::vector<double> scale;        ///< sqrt(w) [(T/M)^(1/2)], > 0
  /// sqrt(w) divided by the allowed residual [L] of the contact, > 0 [(T/M)^(1/2)/L].
  std::vector<double> per_allowed;

  /// Number of contacts.
  std::size_t count() const { return z.size(); }
  /// True if z of contact c is above its bound: the contact is then called free.
  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// Residual |min(D + h G v, w (p - gamma^n))| of contact c, divided by the residual that is
  /// allowed for this contact [1], >= 0. `z_c` is its scaled impulse, `gradient` its scaled
  /// gradient. The contact has converged if the result is at most 1; it is NaN if `gradient` is.
  double residual(std::size_t c, double z_c, double gradient) const {
    return per_allowed[c] * contact_residual(gradient, z_c - bound[c]);
  }

  /// Impulse p of contact c [M L/T]. At the bound it is exactly Contact::lowest, so that the
  /// rounding error of z/scale does not get into the next gamma.
  double impulse(std::size_t c) const { return z[c] == bound[c] ? lowest_[c] : z[c] / scale[c]; }

 protected:
  /// Makes room for `contacts` contacts. The caller must call set() for each of them.
  explicit DualProblem(std::size_t contacts)
      : z(contacts),
        bound(contacts),
        linear_term(contacts),
        scale(contacts),
        per_allowed(contacts),
        lowest_(contacts) {}

  /// Sets contact number `c`. It must have Contact::w > 0 and Contact::allowed > 0. `free_gap` is
  /// its entry of D + h G u* [L].
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
  std::vector<double> lowest_;  // Contact::lowest: gamma^n [M L/T]
};

/// A dual problem that can compute products with its scaled matrix W. It does so by a vector y = B
/// z of displacement_count() numbers, with a matrix B. Each type of problem chooses B:
///
/// - to_bodies(z, y) computes y = B z and returns z^T W z;
/// - combine(y, factor, into) replaces `into` by y + factor * into, which is B z for some z, and
///   returns z^T W z for this z;
/// - to_contact(c, y) returns entry c of W z;
/// - pool() returns the threads for loops over contacts.
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
