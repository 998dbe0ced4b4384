// Sweeps of nonlinear Gauss-Seidel over the contacts and links of a ConstraintProblem.
#pragma once

#include <cstddef>
#include <vector>

#include "viscontact/contact_solver/problem/constraint_problem.hpp"

namespace viscontact::contact_solver {

/// The method of nonsmooth contact dynamics (Jean 1999, "The non-smooth contact dynamics method"):
/// one block after the other gets the impulses that satisfy its own conditions while all others
/// keep theirs. Every second sweep goes through the blocks in reverse order. In practice sweeps
/// always converge, but slowly in large packings.
template <int D>
class ContactSweeps {
 public:
  /// `problem` must outlive this object. Only its impulses may change meanwhile.
  explicit ContactSweeps(ConstraintProblem<D>& problem);

  /// Improves problem.impulses by `count` sweeps. `w` [T/M], > 0, has for each row row_mobilities()
  /// or more, and the same number for both tangential rows of a contact.
  void sweep(int count, const std::vector<double>& w);

 private:
  void solve_block(const ConstraintBlock& block, const double* w);
  // Exact for FrictionBound::kCone unless an impulse on one row changes another, as in bodies.
  void solve_in_cone(const ConstraintBlock& block, const double* w);
  // The impulse that would make the value of a row with the mobility `w` 0 [M L/T].
  double wanted(std::size_t row, double w) const;
  // Sets the impulse of a row, and adds the motions that its change causes.
  void change(std::size_t row, double impulse);

  ConstraintProblem<D>& problem_;
  // For each part of the rows: the motion of its unit by a unit impulse on its row.
  std::vector<Motion<D>> pushes_;
  std::vector<Motion<D>> y_;  // motions of all units with the present impulses [L, rad]
};

}  // namespace viscontact::contact_solver
