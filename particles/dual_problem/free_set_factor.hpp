// A sparse Cholesky factor of the matrix W of mass_dual_problem.hpp (docs/physics.md (5.4)),
// between chosen contacts and with diagonal 1. It serves dual_solver.cpp as a solver and as a
// preconditioner. The chosen contacts are those that are free: their z is above the bound, and
// their linearised gap is 0. Used by dual_solver.hpp.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "viscontact/particles/dual_problem/mass_dual_problem.hpp"

namespace viscontact::particles {

/// Chains, and packings at rest, have as many contacts with impulses as degrees of freedom. W is
/// then so ill-conditioned that iterative methods take as many iterations as a chain has contacts.
/// The factor solves for all impulses between the chosen contacts at once.
template <int D>
class FreeSetFactor {
 public:
  /// `epsilon` >= 0 is added to the diagonal of W, which is 1. W is singular if contacts are
  /// redundant; epsilon then bounds the impulses that these contacts exert on each other.
  explicit FreeSetFactor(double epsilon = 1e-10);
  ~FreeSetFactor();

  /// Factorises W between the contacts c with `free[c]`. Returns false, and leaves no factor, if
  /// the factor would have so many entries that iterations are cheaper (as in packings of spheres)
  /// or if W cannot be factorised. Calls with the same number of contacts share one order of
  /// elimination.
  bool factorise(const MassDualProblem<D>& problem, const std::vector<char>& free);
  /// True if the last factorise() succeeded.
  bool exists() const;

  /// Sets solved = (W + epsilon)^-1 gradient between the contacts of the factor, 0 for all others.
  void solve(std::span<const double> gradient, std::span<double> solved) const;

  /// Applies the factor as a preconditioner, which is symmetric and positive definite on the
  /// contacts that are free now. Free contacts without a row in the factor keep their gradient;
  /// contacts that are not free get 0. `problem` is that of factorise(), or this problem with
  /// further contacts at its end. Returns solved.gradient.
  double precondition(const MassDualProblem<D>& problem, std::span<const double> gradient,
                      std::span<double> solved) const;

 private:
  struct Factor;
  double epsilon_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace viscontact::particles
