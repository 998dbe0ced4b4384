// Sweeps of nonlinear Gauss-Seidel over the constraints of a step (constraint_problem.hpp).
// Lengths, masses and times are in the units of the case. constraint_solver.cpp uses them; nothing
// is thrown.
#pragma once

#include <cstddef>
#include <vector>

#include "viscontact/particles/constraints/constraint_problem.hpp"

namespace viscontact::particles {

/// The method of nonsmooth contact dynamics (Jean 1999, "The non-smooth contact dynamics method"):
/// each block in turn gets the impulses that solve it while all others keep theirs. Every other
/// sweep goes backwards. Sweeps converge in practice always, but slowly in large packings; a few of
/// them give the solver a good start.
template <int D>
class ContactSweeps {
 public:
  /// `problem` must outlive this object.
  explicit ContactSweeps(ConstraintProblem<D>& problem);

  /// Improves problem.impulses by `count` sweeps. `w` are row_mobilities() of the problem.
  void sweep(int count, const std::vector<double>& w);

 private:
  void solve_block(const ConstraintBlock& block, const double* w);
  void solve_in_cone(const ConstraintBlock& block, const double* w);
  double wanted(std::size_t row, double w) const;
  void change(std::size_t row, double impulse);

  ConstraintProblem<D>& problem_;
  std::vector<Motion<D>> pushes_;  // of each part: what a unit impulse of its row changes there
  std::vector<Motion<D>> y_;
};

}  // namespace viscontact::particles
