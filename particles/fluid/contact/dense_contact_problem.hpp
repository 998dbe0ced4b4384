// The contact problem of a step in matrix form, for few contacts. Units are those of the case.
#pragma once

#include <Eigen/Core>

namespace viscontact::particles {

/// Gradient b + W p with p >= gamma (contact_problem.hpp). A contact may have a residual
/// |min(b + W p, W_cc (p - gamma))| of at most `allowed` [L].
struct DenseContactProblem {
  Eigen::MatrixXd w;        ///< [T/M], symmetric, positive semidefinite, with a positive diagonal
  Eigen::VectorXd b;        ///< [L]
  Eigen::VectorXd gamma;    ///< [M L/T], <= 0
  Eigen::VectorXd allowed;  ///< [L], > 0
  Eigen::VectorXd p;        ///< a guess, then the solution [M L/T]
  double error_of_w = 0;    ///< relative error of W, >= 0

  /// Improves p until all residuals are allowed, or for `most` steps. Returns the number of steps.
  ///
  /// The first method is Newton's on the set of contacts with p > gamma (Hintermueller, Ito &
  /// Kunisch 2002, "The primal-dual active set strategy as a semismooth Newton method"). It takes a
  /// few steps from a good guess, but may cycle. Sweeps of Gauss-Seidel with projection on the
  /// bounds, which converge if slowly, follow where it fails.
  int solve(int most);

  /// Largest residual over the allowed one; the problem is solved if it is at most 1.
  double excess() const;
};

}  // namespace viscontact::particles
