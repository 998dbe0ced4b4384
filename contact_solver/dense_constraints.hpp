// Contacts with friction whose mobility is a matrix, as in a fluid.
#pragma once

#include <vector>

#include "viscontact/contact_solver/problem/constraint_problem.hpp"
#include "viscontact/contact_solver/problem/dual_problem.hpp"

namespace viscontact::contact_solver {

/// Rows in the plane whose values are offsets + W impulses. The blocks are those of a
/// ConstraintProblem.
struct DenseConstraints {
  /// W [T/M], row by row, with a positive diagonal. It need not be symmetric: moving fluid carries
  /// the effect of an impulse downstream.
  std::vector<double> w;
  double error = 0;             ///< relative error of W [1], > 0
  double rounding = 0;          ///< error of each offset [L], >= 0
  std::vector<double> offsets;  ///< values without impulses [L]
  std::vector<ConstraintBlock> blocks;
  std::vector<double> impulses;  ///< [M L/T]: a guess, then the solution
};

/// Improves the impulses as solve_constraints() with ConstraintStart::kLeastImpulses does, in at
/// most about `max_iterations`. With `gives_loads` the loads of the guess bound the friction,
/// (5.17), not those of the solution. The residual is that of the last round: the skew part of W
/// times the impulses of a round is added to the offsets of the next one.
///
/// Motions of units with W = J J^T take the place of W, because steps (5.8), paths and interior
/// points are sparse factorisations in the motions of units. W itself would not do: where contacts
/// are redundant, it is singular, and its errors make eigenvalues negative (up to 6 of 52 are 0 in
/// heaps of discs), so that its eigenvectors are needed anyway, to remove from the offsets what no
/// impulse can change. The eigenvectors take 3 % of the time of solutions with 2 to 52 rows, and
/// nothing that can be measured beside a fluid.
SolverResult solve_dense_constraints(DenseConstraints& problem, int max_iterations,
                                     bool gives_loads);

}  // namespace viscontact::contact_solver
