// The convex problem of a step, docs/physics.md (5.4), in dense matrices, and a dense solver for it
// that shares no code with the solver under test. Numbers have no units.
#pragma once

#include <Eigen/Dense>

namespace viscontact::contact_solver {

/// A projection in dense matrices. The impulses are p = gamma^n + x with x >= 0. If all films pull
/// with all that they have absorbed, p = gamma^n and the displacements are y0. The solution
/// y = y0 + h M^-1 G^T x is the point nearest to y0, in the norm of M/h, with D + G y >= 0.
struct DenseProblem {
  Eigen::MatrixXd g;       // G: unit normals, a row for each contact
  Eigen::VectorXd gap;     // D of each contact
  Eigen::VectorXd gamma;   // gamma^n of each contact, the lower bound of its impulse
  Eigen::VectorXd weight;  // m/h, for each component of each particle
  Eigen::VectorXd free;    // displacements h u* without contacts

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

/// The impulses of the solution; if they are not unique, those of one solution. Least distance
/// programming (Lawson & Hanson 1974, "Solving least squares problems", chapter 23).
Eigen::VectorXd solve(const DenseProblem& problem);

}  // namespace viscontact::contact_solver
