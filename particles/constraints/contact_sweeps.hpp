// Sweeps of nonlinear Gauss-Seidel over the contacts, and the links (hinges, arms, springs), of a
// time step: each sweep improves the impulses in a ConstraintProblem (constraint_problem.hpp). A
// row of this problem is one scalar: a gap, a slip, or the left side of a link's equation. Lengths
// [L], masses [M] and times [T] are in any consistent units; a row of angles has [rad] in place of
// [L], and [M L^2/T] in place of [M L/T]. Nothing is checked, thrown or measured: the caller must
// compute the residuals. constraint_solver.cpp uses the sweeps. Another order of blocks or sums
// would change results within the tolerances.
#pragma once

#include <cstddef>
#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// The method of nonsmooth contact dynamics (Jean 1999, "The non-smooth contact dynamics method"):
/// one block (contact or link) after the other gets the impulses that satisfy its own conditions
/// while all others keep theirs. Every second sweep goes through the blocks in reverse order. In
/// practice sweeps always converge, but slowly in large packings.
template <int D>
class ContactSweeps {
 public:
  /// `problem` must outlive this object. Only its impulses may change meanwhile.
  explicit ContactSweeps(ConstraintProblem<D>& problem);

  /// Improves problem.impulses [M L/T], one for each row, by `count` sweeps, >= 0; 0 changes
  /// nothing. `w` [T/M], > 0, has one number for each row, at least that of row_mobilities(): the
  /// change of its value by a unit impulse. Both tangential rows of a contact have the same number.
  void sweep(int count, const std::vector<double>& w);

 private:
  void solve_block(const ConstraintBlock& block, const double* w);
  void solve_in_cone(const ConstraintBlock& block, const double* w);
  double wanted(std::size_t row, double w) const;
  void change(std::size_t row, double impulse);

  ConstraintProblem<D>& problem_;
  // For each part of the rows: the motion of its unit that a unit impulse on its row causes.
  std::vector<Motion<D>> pushes_;
  std::vector<Motion<D>> y_;  // motions of all units with the present impulses [L, rad]
};

}  // namespace viscontact::particles
