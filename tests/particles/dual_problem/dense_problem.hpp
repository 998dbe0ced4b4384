// The convex problem of a step in dense matrices, and a dense solver for it that shares no code
// with the solver under test. Dimensionless.
#pragma once

#include <Eigen/Dense>

namespace viscontact::particles {

/// A projection in dense matrices. With all films pulling as much as they have, gamma^n, the rest
/// is a plain one: p = gamma^n + x, x >= 0, y = y0 + h M^-1 G^T x the point nearest to y0 (in the
/// norm of M/h) with D + G y >= 0.
struct DenseProblem {
  Eigen::MatrixXd g;       // G
  Eigen::VectorXd gap;     // D
  Eigen::VectorXd gamma;   // gamma^n
  Eigen::VectorXd weight;  // m/h, of each number of each body
  Eigen::VectorXd free;    // h u*

  Eigen::VectorXd displacements(const Eigen::VectorXd& impulses) const {
    return free + Eigen::VectorXd((g.transpose() * impulses).cwiseQuotient(weight));
  }
  Eigen::VectorXd gradient(const Eigen::VectorXd& impulses) const {
    return gap + g * displacements(impulses);
  }
  /// w of each contact: h/m_i + h/m_j.
  Eigen::VectorXd diagonal() const {
    return (g.cwiseAbs2() * weight.cwiseInverse().asDiagonal()).rowwise().sum();
  }
  /// 1/2 p^T W p + b^T p.
  double objective(const Eigen::VectorXd& p) const {
    return p.dot(gradient(p) + gradient(Eigen::VectorXd::Zero(p.size()))) / 2;
  }
};

/// The impulses; where they are not unique, some of them. Least distance programming (Lawson &
/// Hanson 1974, "Solving least squares problems", chapter 23).
Eigen::VectorXd solve(const DenseProblem& problem);

}  // namespace viscontact::particles
