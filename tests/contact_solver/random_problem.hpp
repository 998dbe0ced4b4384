// Problems of a step with random contacts, for the solver under test and as dense matrices. Numbers
// have no units.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/common/random.hpp"
#include "tests/contact_solver/dense_problem.hpp"
#include "viscontact/contact_solver/problem/mass_dual_problem.hpp"

namespace viscontact::contact_solver {

template <int D>
struct Problem {
  std::vector<GapRow<D>> contacts;
  std::vector<double> displacements, mobilities;

  /// Sets the w of each contact, which follows from the mobilities.
  void set_w() {
    for (auto& contact : contacts)
      contact.bounds.w = (contact.first < 0 ? 0 : mobilities[index_of(contact.first)]) +
                         mobilities[index_of(contact.second)];
  }

  DenseProblem dense() const {
    const auto rows = static_cast<Eigen::Index>(contacts.size());
    const auto columns = static_cast<Eigen::Index>(displacements.size());
    DenseProblem result{Eigen::MatrixXd::Zero(rows, columns), Eigen::VectorXd(rows),
                        Eigen::VectorXd(rows), Eigen::VectorXd(columns),
                        Eigen::Map<const Eigen::VectorXd>(displacements.data(), columns)};
    for (Eigen::Index c = 0; c < rows; ++c) {
      const auto& contact = contacts[static_cast<std::size_t>(c)];
      result.gap[c] = contact.gap;
      result.gamma[c] = contact.bounds.lowest;
      for (int d = 0; d < D; ++d) {
        const double n = contact.normal[static_cast<std::size_t>(d)];
        if (contact.first >= 0) result.g(c, contact.first * D + d) = -n;
        result.g(c, contact.second * D + d) = n;
      }
    }
    for (Eigen::Index k = 0; k < columns; ++k)
      result.weight[k] = 1 / mobilities[static_cast<std::size_t>(k / D)];
    return result;
  }
};

/// One to ten particles, and up to four contacts for each of them, whose normals are random and
/// need not fit to any places. All gaps are >= 0, so that zero displacements are allowed.
template <int D>
Problem<D> random_problem(Random& random) {
  Problem<D> problem;
  const int bodies = random.integer(1, 10);
  const double masses = random.uniform(0, 1.5);
  for (int b = 0; b < bodies; ++b) {
    problem.mobilities.push_back(random.decades(-masses, masses));
    for (int d = 0; d < D; ++d) problem.displacements.push_back(random.uniform(-1, 1));
  }
  const int contacts = random.integer(1, 4 * bodies);
  for (int c = 0; c < contacts; ++c) {
    GapRow<D> contact;
    contact.second = random.integer(0, bodies - 1);
    contact.first = random.integer(-1, bodies - 1);
    if (contact.first == contact.second) contact.first = -1;
    const auto normal = random.direction(D);
    std::copy_n(normal.begin(), D, contact.normal.begin());
    contact.gap = random.chance(0.5) ? 0 : random.uniform(0, 0.5);
    contact.bounds.lowest = random.chance(0.5) ? 0 : -random.decades(-3, 1);
    contact.bounds.impulse = random.chance(0.5) ? 0 : random.uniform(contact.bounds.lowest, 1);
    problem.contacts.push_back(contact);
  }
  problem.set_w();
  return problem;
}

}  // namespace viscontact::contact_solver
