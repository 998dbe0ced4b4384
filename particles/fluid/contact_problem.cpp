// Solves the contact problem of a step in a fluid (contact_problem.hpp): assembles W by one product
// with the mobility for each contact, and finds the set of contacts that carry more than their
// bound. Units are those of the case.
#include "viscontact/particles/fluid/contact_problem.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "viscontact/particles/particles.hpp"

namespace viscontact::particles {
namespace {

using Eigen::Index;

/// The problem in matrix form: gradient b + W p, bounds gamma.
struct DenseProblem {
  Eigen::MatrixXd w;
  Eigen::VectorXd b, gamma, p;

  Eigen::VectorXd gradient() const { return b + w * p; }
  /// Residual of contact c [L].
  double residual(Index c, double gradient_c) const {
    return std::min(gradient_c, w(c, c) * (p[c] - gamma[c]));
  }
  double largest_residual_over(const Eigen::VectorXd& allowed) const {
    const auto g = gradient();
    double largest = 0;
    for (Index c = 0; c < p.size(); ++c)
      largest = std::max(largest, std::abs(residual(c, g[c])) / allowed[c]);
    return largest;
  }
};

DenseProblem assemble(std::span<const FluidContact> contacts,
                      std::span<const double> free_velocities, double h, const Mobility& mobility,
                      const MotionLayout& layout) {
  const auto n = static_cast<Index>(contacts.size());
  DenseProblem problem{Eigen::MatrixXd(n, n), Eigen::VectorXd(n), Eigen::VectorXd(n),
                       Eigen::VectorXd(n)};
  std::vector<double> forces(free_velocities.size());
  for (Index c = 0; c < n; ++c) {
    const auto& contact = contacts[static_cast<std::size_t>(c)];
    std::ranges::fill(forces, 0.0);
    add_contact_force(contact, 1, forces, layout);
    const auto velocities = mobility(forces);
    for (Index k = 0; k < n; ++k)
      problem.w(k, c) = opening(contacts[static_cast<std::size_t>(k)], velocities, layout);
    problem.b[c] = contact.gap + h * opening(contact, free_velocities, layout);
    problem.gamma[c] = contact.gamma;
    problem.p[c] = std::max(contact.impulse, contact.gamma);
  }
  // The mobility is symmetric to the accuracy of the solver.
  problem.w = (problem.w + problem.w.transpose().eval()) / 2;
  return problem;
}

/// Sweeps of Gauss-Seidel with projection on the bounds, which converge for every positive definite
/// W, if slowly.
int sweep(DenseProblem& problem, const Eigen::VectorXd& allowed, int most) {
  int sweeps = 0;
  while (sweeps < most && problem.largest_residual_over(allowed) > 1) {
    for (Index c = 0; c < problem.p.size(); ++c) {
      const double g = problem.b[c] + problem.w.row(c).dot(problem.p);
      problem.p[c] = std::max(problem.gamma[c], problem.p[c] - g / problem.w(c, c));
    }
    ++sweeps;
  }
  return sweeps;
}

/// Newton's method on the set of contacts with p > gamma (Hintermueller, Ito & Kunisch 2002, "The
/// primal-dual active set strategy as a semismooth Newton method"). It takes a few steps from a good
/// guess, but may cycle.
int active_set(DenseProblem& problem, const Eigen::VectorXd& allowed, int most) {
  int steps = 0;
  const auto n = problem.p.size();
  while (steps < most && problem.largest_residual_over(allowed) > 1) {
    const auto g = problem.gradient();
    std::vector<Index> free;
    for (Index c = 0; c < n; ++c) {
      if (problem.w(c, c) * (problem.p[c] - problem.gamma[c]) - g[c] > 0)
        free.push_back(c);
      else
        problem.p[c] = problem.gamma[c];
    }
    const auto m = static_cast<Index>(free.size());
    Eigen::VectorXd rhs(m);
    for (Index i = 0; i < m; ++i) problem.p[free[static_cast<std::size_t>(i)]] = 0;
    const auto rest = problem.gradient();
    for (Index i = 0; i < m; ++i) rhs[i] = -rest[free[static_cast<std::size_t>(i)]];
    const Eigen::MatrixXd part = problem.w(free, free);
    const Eigen::VectorXd solved = part.ldlt().solve(rhs);
    for (Index i = 0; i < m; ++i) problem.p[free[static_cast<std::size_t>(i)]] = solved[i];
    ++steps;
  }
  return steps;
}

}  // namespace

double opening(const FluidContact& contact, std::span<const double> velocities,
               const MotionLayout& layout) {
  double sum = 0;
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    sum += contact.normal[d] * velocities[layout.at(contact.second, d)];
    if (contact.first >= 0)
      sum -= contact.normal[d] * velocities[layout.at(contact.first, d)];
  }
  return sum;
}

void add_contact_force(const FluidContact& contact, double force, std::span<double> forces,
                       const MotionLayout& layout) {
  for (std::size_t d = 0; d < layout.directions(); ++d) {
    forces[layout.at(contact.second, d)] += contact.normal[d] * force;
    if (contact.first >= 0) forces[layout.at(contact.first, d)] -= contact.normal[d] * force;
  }
}

ContactSolution solve_contact_problem(std::span<FluidContact> contacts,
                                      std::span<const double> free_velocities, double h,
                                      const Mobility& mobility, const MotionLayout& layout,
                                      const SolverSettings& settings, double mean_radius) {
  ContactSolution solution;
  if (contacts.empty()) return solution;
  auto problem = assemble(contacts, free_velocities, h, mobility, layout);
  const auto n = problem.p.size();
  solution.iterations = static_cast<int>(n);
  // An impulse is as exact as `impulse_tolerance` says relative to those that would close the gap.
  Eigen::VectorXd allowed(n);
  for (Index c = 0; c < n; ++c) {
    const double scale = std::max(std::abs(problem.b[c]), -problem.w(c, c) * problem.gamma[c]);
    constexpr double kRounding = 1e-14;
    allowed[c] = std::min(settings.tolerance * mean_radius / 2,
                          std::max(settings.impulse_tolerance * scale, kRounding * mean_radius));
  }
  constexpr int kNewtonSteps = 50;
  solution.iterations += active_set(problem, allowed, kNewtonSteps);
  solution.iterations += sweep(problem, allowed, settings.max_iterations);
  solution.converged = problem.largest_residual_over(allowed) <= 1;
  const auto g = problem.gradient();
  for (Index c = 0; c < n; ++c) {
    auto& contact = contacts[static_cast<std::size_t>(c)];
    contact.impulse = std::max(problem.p[c], problem.gamma[c]);
    contact.w = problem.w(c, c);
    contact.residual = std::abs(problem.residual(c, g[c]));
  }
  return solution;
}

}  // namespace viscontact::particles
