// Sweeps of nonlinear Gauss-Seidel over the contacts and links of a time step: each sweep improves
// the impulses of the problem of constraint_problem.hpp. Lengths, masses and times are in any
// consistent units. Nothing is checked or thrown. constraint_solver.cpp uses them. Results depend
// on the order of blocks and sums.
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
  /// `problem` must outlive this object, and its units, rows and blocks must not change.
  explicit ContactSweeps(ConstraintProblem<D>& problem);

  /// Improves problem.impulses [M L/T] by `count` >= 0 sweeps. `w` [T/M], > 0, are the
  /// row_mobilities() of the problem, one for each row; both tangential rows of a contact must have
  /// the same one.
  void sweep(int count, const std::vector<double>& w);

 private:
  void solve_block(const ConstraintBlock& block, const double* w);
  void solve_in_cone(const ConstraintBlock& block, const double* w);
  double wanted(std::size_t row, double w) const;
  void change(std::size_t row, double impulse);

  ConstraintProblem<D>& problem_;
  std::vector<Motion<D>> pushes_;  // for each part: motion of its unit by a unit impulse on its row
  std::vector<Motion<D>> y_;       // motions of all units with the present impulses [L, rad]
};

}  // namespace viscontact::particles
