// One block after the other, for (5.6) to (5.9), docs/physics.md.
#include "viscontact/contact_solver/methods/contact_sweeps.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "viscontact/contact_solver/problem/contact_conditions.hpp"

namespace viscontact::contact_solver {

template <int D>
ContactSweeps<D>::ContactSweeps(ConstraintProblem<D>& problem) : problem_(problem) {
  pushes_.reserve(problem.parts.size());
  for (const auto& [unit, coefficients] : problem.parts)
    pushes_.push_back(problem.units[static_cast<std::size_t>(unit)].moved_by(coefficients));
}

template <int D>
double ContactSweeps<D>::wanted(std::size_t row, double w) const {
  return problem_.impulses[row] - (problem_.rows[row].offset + problem_.product(row, y_)) / w;
}

template <int D>
void ContactSweeps<D>::change(std::size_t row, double impulse) {
  const double by = impulse - problem_.impulses[row];
  problem_.impulses[row] = impulse;
  if (by == 0) return;
  const auto first = problem_.rows[row].first_part;
  for (std::size_t part = first; part < first + problem_.rows[row].parts; ++part) {
    auto& motion = y_[static_cast<std::size_t>(problem_.parts[part].unit)];
    for (std::size_t k = 0; k < motion.size(); ++k) motion[k] += pushes_[part][k] * by;
  }
}

template <int D>
void ContactSweeps<D>::solve_block(const ConstraintBlock& block, const double* w) {
  if (!block.is_contact) {
    for (std::size_t k = 0; k < block.rows; ++k) {
      // The change dp of the impulse p obeys v + w dp + compliance (p + dp) = 0.
      const double p = problem_.impulses[block.row + k];
      const double rigid = wanted(block.row + k, w[k]) - p;
      change(block.row + k, p + (w[k] * rigid - block.compliance * p) / (w[k] + block.compliance));
    }
    return;
  }
  if (block.is_in_cone()) {
    solve_in_cone(block, w);
    return;
  }
  // The normal row is solved first, because a normal impulse on discs and spheres causes no slip.
  change(block.row, std::max(block.lowest, wanted(block.row, w[0])));
  if (block.rows == 1) return;
  const double bound = block.bound(problem_.impulses[block.row]);
  std::array<double, 2> to{};
  double square = 0;
  for (std::size_t k = 1; k < block.rows; ++k) {
    to[k - 1] = bound > 0 ? wanted(block.row + k, w[k]) : 0;
    square += to[k - 1] * to[k - 1];
  }
  const double factor = square > bound * bound ? bound / std::sqrt(square) : 1;
  for (std::size_t k = 1; k < block.rows; ++k) change(block.row + k, factor * to[k - 1]);
}

template <int D>
void ContactSweeps<D>::solve_in_cone(const ConstraintBlock& block, const double* w) {
  // The changes of row k by unit impulses on rows l, over w[k], are a matrix whose eigenvalues are
  // at most the largest sum of magnitudes in one of its rows. A step that is shorter by this factor
  // reduces the convex function that the solution minimises.
  double largest = 1;
  for (std::size_t k = 0; k < block.rows; ++k) {
    double sum = 0;
    for (std::size_t l = 0; l < block.rows; ++l) {
      const auto parts = problem_.parts_of(block.row + k);
      const Motion<D>* pushes = &pushes_[problem_.rows[block.row + l].first_part];
      double by = 0;
      for (std::size_t part = 0; part < parts.size(); ++part)
        for (std::size_t i = 0; i < pushes[part].size(); ++i)
          by += parts[part].coefficients[i] * pushes[part][i];
      sum += std::abs(by);
    }
    largest = std::max(largest, sum / w[k]);
  }
  std::array<double, kMostRows> to{};
  double square = 0;
  for (std::size_t k = 0; k < block.rows; ++k) {
    to[k] = wanted(block.row + k, largest * w[k]);
    if (k > 0) square += to[k] * to[k];
  }
  const auto cone = FrictionCone::nearest(block.friction, to[0], std::sqrt(square), w[0], w[1]);
  change(block.row, cone.load);
  for (std::size_t k = 1; k < block.rows; ++k) change(block.row + k, cone.tangential * to[k]);
}

template <int D>
void ContactSweeps<D>::sweep(int count, const std::vector<double>& w) {
  assert(w.size() == problem_.rows.size());
  y_ = motions<D>(problem_, problem_.impulses);
  const auto& blocks = problem_.blocks;
  for (int n = 0; n < count; ++n)
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      const auto& block = blocks[n % 2 == 0 ? i : blocks.size() - 1 - i];
      solve_block(block, &w[block.row]);
    }
}

template class ContactSweeps<2>;
template class ContactSweeps<3>;

}  // namespace viscontact::contact_solver
