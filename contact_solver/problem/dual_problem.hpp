// The problem (5.4), docs/physics.md, for the impulses of contacts in scaled unknowns, without and
// with a fluid; there M stands for M/L.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/contact_solver/problem/contact_conditions.hpp"
#include "viscontact/contact_solver/stages/stages.hpp"

namespace viscontact::contact_solver {

/// What a frictionless contact has besides its gap.
struct ContactBounds {
  double w = 0;        ///< change of the gap per impulse [T/M], > 0
  double impulse = 0;  ///< a guess [M L/T]
  double lowest = 0;   ///< lower bound of the impulse [M L/T]
  double allowed = 0;  ///< residual with which it counts as converged [L], > 0
};

struct SolverResult {
  int iterations = 0;
  /// Largest DualProblem::residual() of all contacts [1]; infinite if the method gave up. At most 1
  /// if all contacts have converged. NaN if a number of the problem is NaN.
  double residual = 0;
  StagesRun stages;  ///< which methods ran
};

/// The unknowns are the impulses p [M L/T] of the contacts. Without them the particles have the
/// velocities u* and move by h u* [L] in the step of length h. Impulses change this displacement by
/// S G^T p with the mobility S [T/M] and the matrix G, for which G v are the velocities at which
/// the gaps open. D [L] are the gaps at the beginning of the step, and gamma^n <= 0 [M L/T] the
/// lower bounds of the impulses: a film between two particles i and j can give back at most the
/// impulse -gamma^n that it has absorbed. The problem is
///
///     minimise  1/2 p^T W p + b^T p  over  p_ij >= gamma_ij^n,
///     W = G S G^T,   b = D + h G u*;   the gradient W p + b is D + h G v.
///
/// with the velocities v that the impulses p cause. For each contact the solution has p >= gamma^n
/// and a gap D + h G v >= 0 at the end of the step, and one of the two is an equality. If gamma^n <
/// 0, a pull of at most -gamma^n thus keeps the gap at 0; if a larger pull would be needed, the gap
/// opens within the step.
///
/// The problem is scaled so that the diagonal of W is about 1. With w = ContactBounds::w, the
/// diagonal of W or an estimate of it [T/M], the scaled impulses are z = sqrt(w) p, and the
/// gradient of a contact is divided by sqrt(w). Both are in L (M/T)^(1/2).
class DualProblem {
 public:
  // The arrays have one number for each contact.
  std::vector<double> z;            ///< scaled impulses z = sqrt(w) p
  std::vector<double> bound;        ///< lower bound of z: sqrt(w) gamma^n
  std::vector<double> linear_term;  ///< b/sqrt(w): the gradient at z = 0
  std::vector<double> scale;        ///< sqrt(w) [(T/M)^(1/2)], > 0
  /// sqrt(w) over the allowed residual of the contact [(T/M)^(1/2)/L], > 0.
  std::vector<double> per_allowed;

  std::size_t count() const { return z.size(); }
  /// True if z of contact c is above its bound.
  bool is_free(std::size_t c) const { return z[c] > bound[c]; }

  /// Residual |min(D + h G v, w (p - gamma^n))| of contact c over its allowed residual [1], for its
  /// scaled impulse and gradient; NaN if `gradient` is.
  double residual(std::size_t c, double z_c, double gradient) const {
    return per_allowed[c] * contact_residual(gradient, z_c - bound[c]);
  }

  /// Impulse p of contact c [M L/T]. At the bound it is exactly ContactBounds::lowest, so that the
  /// rounding error of z/scale does not get into the next gamma.
  double impulse(std::size_t c) const { return z[c] == bound[c] ? lowest_[c] : z[c] / scale[c]; }

 protected:
  /// The caller must call set() for each contact.
  explicit DualProblem(std::size_t contacts)
      : z(contacts),
        bound(contacts),
        linear_term(contacts),
        scale(contacts),
        per_allowed(contacts),
        lowest_(contacts) {}

  /// `free_gap` is the entry of the contact in D + h G u* [L].
  void set(std::size_t c, const ContactBounds& bounds, double free_gap) {
    assert(c < count() && bounds.w > 0);
    const double root = std::sqrt(bounds.w);
    scale[c] = root;
    per_allowed[c] = root / bounds.allowed;
    z[c] = std::max(bounds.impulse, bounds.lowest) * root;
    bound[c] = bounds.lowest * root;
    lowest_[c] = bounds.lowest;
    linear_term[c] = free_gap / root;
  }

 private:
  std::vector<double> lowest_;  // gamma^n [M L/T]
};

/// A dual problem that can compute products with its scaled matrix W by a vector y = B z of
/// displacement_count() numbers, with a matrix B of its own:
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

}  // namespace viscontact::contact_solver
