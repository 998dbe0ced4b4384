// Block Gauss-Seidel with Coulomb's law (contact_sweeps.hpp).
#include "viscontact/particles/constraints/contact_sweeps.hpp"

#include <algorithm>
#include <cmath>

namespace viscontact::particles {

template <int D>
ContactSweeps<D>::ContactSweeps(ConstraintProblem<D>& problem) : problem_(problem) {
  pushes_.reserve(problem.rows.size());
  const auto unit = [&](std::int32_t u) { return problem.units[static_cast<std::size_t>(u)]; };
  for (const auto& row : problem.rows)
    pushes_.push_back({row.first < 0 ? Motion<D>{} : unit(row.first).moved_by(row.of_first),
                       unit(row.second).moved_by(row.of_second)});
}

/// The impulse of a row that would make its value 0.
template <int D>
double ContactSweeps<D>::wanted(std::size_t row, double w) const {
  return problem_.impulses[row] -
         (problem_.rows[row].offset + product<D>(problem_.rows[row], y_)) / w;
}

template <int D>
void ContactSweeps<D>::change(std::size_t row, double impulse) {
  const double by = impulse - problem_.impulses[row];
  problem_.impulses[row] = impulse;
  if (by == 0) return;
  const auto add = [&](std::int32_t unit, const Motion<D>& push) {
    auto& motion = y_[static_cast<std::size_t>(unit)];
    for (std::size_t k = 0; k < motion.size(); ++k) motion[k] += push[k] * by;
  };
  const auto& r = problem_.rows[row];
  add(r.second, pushes_[row][1]);
  if (r.first >= 0) add(r.first, pushes_[row][0]);
}

template <int D>
void ContactSweeps<D>::solve_block(const ConstraintBlock& block, const double* w) {
  if (!block.is_contact) {
    for (std::size_t k = 0; k < block.rows; ++k) {
      // v + w dp + compliance (p + dp) = 0
      const double p = problem_.impulses[block.row + k];
      const double rigid = wanted(block.row + k, w[k]) - p;
      change(block.row + k, p + (w[k] * rigid - block.compliance * p) / (w[k] + block.compliance));
    }
    return;
  }
  if (is_in_cone(block, problem_.lifts_sliding, problem_.impulses[block.row])) {
    solve_in_cone(block, w);
    return;
  }
  // Normal and tangential rows of discs and spheres do not act on each other.
  change(block.row, std::max(block.lowest, wanted(block.row, w[0])));
  if (block.rows == 1) return;
  // In the convex relaxation the solids carry load from the next sweep on.
  const double bound = problem_.lifts_sliding ? 0 : block.bound(problem_.impulses[block.row]);
  std::array<double, 2> to{};
  double square = 0;
  for (std::size_t k = 1; k < block.rows; ++k) {
    to[k - 1] = bound > 0 ? wanted(block.row + k, w[k]) : 0;
    square += to[k - 1] * to[k - 1];
  }
  const double factor = square > bound * bound ? bound / std::sqrt(square) : 1;
  for (std::size_t k = 1; k < block.rows; ++k) change(block.row + k, factor * to[k - 1]);
}

/// Improves the impulses of a contact in the cone of (5.9). The result is exact unless the rows of
/// the contact act on each other, which they do in rigid bodies.
template <int D>
void ContactSweeps<D>::solve_in_cone(const ConstraintBlock& block, const double* w) {
  // The sums of the rows of (what the rows do to each other)/w bound the eigenvalues. With steps
  // that are shorter by the largest sum the energy of the block falls.
  double largest = 1;
  for (std::size_t k = 0; k < block.rows; ++k) {
    double sum = 0;
    for (std::size_t l = 0; l < block.rows; ++l) {
      const auto& row = problem_.rows[block.row + k];
      const auto& pushes = pushes_[block.row + l];
      double by = 0;
      for (std::size_t i = 0; i < row.of_second.size(); ++i)
        by += row.of_second[i] * pushes[1][i] + row.of_first[i] * pushes[0][i];
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
  const auto cone =
      FrictionCone::nearest(block.friction, to[0] - block.capacity, std::sqrt(square), w[0], w[1]);
  change(block.row, block.capacity + cone.load);
  for (std::size_t k = 1; k < block.rows; ++k) change(block.row + k, cone.tangential * to[k]);
}

template <int D>
void ContactSweeps<D>::sweep(int count, const std::vector<double>& w) {
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

}  // namespace viscontact::particles
