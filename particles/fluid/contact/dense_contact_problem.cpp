// Solves the contact problem in matrix form (dense_contact_problem.hpp). Units are those of the
// case.
#include "viscontact/particles/fluid/contact/dense_contact_problem.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// One step of Newton's method on the set of contacts with p > gamma.
void active_set_step(DenseContactProblem& problem) {
  auto& p = problem.p;
  const Eigen::VectorXd gradient = problem.b + problem.w * p;
  std::vector<Index> free;
  for (Index c = 0; c < p.size(); ++c) {
    if (problem.w(c, c) * (p[c] - problem.gamma[c]) - gradient[c] > 0)
      free.push_back(c);
    else
      p[c] = problem.gamma[c];
  }
  Eigen::MatrixXd part = problem.w(free, free);
  // Redundant contacts make W singular but for its errors. A term as large as these bounds the
  // impulses that such contacts exert on each other. Refinement removes what it changes elsewhere.
  part.diagonal() *= 1 + problem.error_of_w;
  const Eigen::LDLT<Eigen::MatrixXd> factor(part);
  constexpr int kRefinements = 2;
  for (int i = 0; i <= kRefinements; ++i) {
    const Eigen::VectorXd rest = problem.b + problem.w * p;
    p(free) -= factor.solve(rest(free));
  }
}

void sweep(DenseContactProblem& problem) {
  auto& p = problem.p;
  for (Index c = 0; c < p.size(); ++c) {
    const double gradient = problem.b[c] + problem.w.row(c).dot(p);
    p[c] = std::max(problem.gamma[c], p[c] - gradient / problem.w(c, c));
  }
}

}  // namespace

double DenseContactProblem::excess() const {
  const Eigen::VectorXd gradient = b + w * p;
  double largest = 0;
  for (Index c = 0; c < p.size(); ++c) {
    const double residual = std::min(gradient[c], w(c, c) * (p[c] - gamma[c]));
    largest = std::max(largest, std::abs(residual) / allowed[c]);
  }
  return largest;
}

int DenseContactProblem::solve(int most) {
  constexpr int kNewtonSteps = 50;
  int steps = 0;
  for (; steps < std::min(most, kNewtonSteps) && excess() > 1; ++steps) active_set_step(*this);
  if (excess() > 1) p = p.cwiseMax(gamma);
  for (; steps < most && excess() > 1; ++steps) sweep(*this);
  p = p.cwiseMax(gamma);
  return steps;
}

}  // namespace viscontact::particles
