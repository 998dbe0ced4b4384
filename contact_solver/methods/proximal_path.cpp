// The path for discs of which proximal_step.hpp speaks: on it the error is 1 - share times that at
// the start. It consists of straight pieces, on which no contact changes its branch.
#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/contact_solver/methods/proximal_step.hpp"

namespace viscontact::contact_solver {

/// The change of the matrix of Newton's method when a block changes its branch: J^T column (row J),
/// with the coefficients J of the two rows of the block, `column` [1] and `row` [M/T]. It is a
/// product of two vectors because the projection is continuous.
template <int D>
struct ProximalStep<D>::Crossing {
  std::size_t block = 0;
  std::array<double, 2> column{}, row{};
};

template <int D>
std::array<double, 4> ProximalStep<D>::derivatives(std::size_t b, Branch branch) const {
  const double slope = problem_.blocks[b].friction;
  const double closed = branch.is_closed ? 1 : 0;
  switch (branch.friction) {
    case Friction::kNone:
      return {closed, 0, 0, 0};
    case Friction::kSticks:
      return {closed, 0, 0, 1};
    case Friction::kSlips:
      return {closed, 0, slope, 0};
    case Friction::kSlipsBack:
      return {closed, 0, -slope, 0};
  }
  return {};
}

template <int D>
typename ProximalStep<D>::Crossing ProximalStep<D>::crossing_to(std::size_t b,
                                                                Branch branch) const {
  const auto before = derivatives(b, branches_[b]), after = derivatives(b, branch);
  std::array<double, 4> change;
  std::size_t largest = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    change[k] = after[k] - before[k];
    if (std::abs(change[k]) > std::abs(change[largest])) largest = k;
  }
  Crossing crossing{b, {change[largest % 2], change[2 + largest % 2]}, {}};
  const std::size_t i = largest / 2;
  for (std::size_t k = 0; k < problem_.blocks[b].rows; ++k)
    crossing.row[k] = change[2 * i + k] / change[largest] * rho_[problem_.blocks[b].row + k];
  return crossing;
}

template <int D>
double ProximalStep<D>::product(const Crossing& crossing,
                                std::span<const Motion<D>> motions) const {
  double sum = 0;
  for (std::size_t k = 0; k < 2; ++k)
    if (crossing.row[k] != 0)
      sum += crossing.row[k] * problem_.product(problem_.blocks[crossing.block].row + k, motions);
  return sum;
}

template <int D>
typename ProximalStep<D>::Exit ProximalStep<D>::exit_of(std::size_t b, double sign) const {
  assert(std::abs(sign) == 1);
  const auto& block = problem_.blocks[b];
  Exit exit;
  if (!block.is_contact) return exit;
  std::array<double, kMostRows> q{}, change{};
  unprojected(b, 0, q.data());
  for (std::size_t k = 0; k < block.rows; ++k)
    change[k] = -sign * rho_[block.row + k] * changes_[block.row + k];
  // The branch ends where a condition `value` >= 0, which changes at the rate `by`, fails.
  const auto test = [&](double value, double by, Branch next) {
    if (!(by < 0)) return;
    const double length = std::max(0.0, -value / by);
    if (length < exit.length) exit = {length, next};
  };
  const bool rubs = block.rows > 1, has_film = !rubs || block.capacity > block.lowest;
  const double load = q[0] - block.capacity;
  const auto slips = [&](double value, double by) {
    const double at = q[1] + std::max(0.0, -value / by) * change[1];
    return Branch{true, at > 0 ? Friction::kSlips : Friction::kSlipsBack};
  };
  const Branch open{}, film{true}, unloaded{has_film};
  const auto here = branches_[b];
  if (!here.is_closed) {
    const double value = block.lowest - q[0];
    test(value, -change[0], has_film ? film : slips(value, -change[0]));
    return exit;
  }
  const double mu = block.friction;
  switch (here.friction) {
    case Friction::kNone:
      test(q[0] - block.lowest, change[0], open);
      if (rubs) test(-load, -change[0], slips(-load, -change[0]));
      break;
    case Friction::kSticks:
      test(mu * load - q[1], mu * change[0] - change[1], {true, Friction::kSlips});
      test(mu * load + q[1], mu * change[0] + change[1], {true, Friction::kSlipsBack});
      break;
    case Friction::kSlips:
      test(q[1] - mu * load, change[1] - mu * change[0], {true, Friction::kSticks});
      test(load, change[0], unloaded);
      break;
    case Friction::kSlipsBack:
      test(-q[1] - mu * load, -change[1] - mu * change[0], {true, Friction::kSticks});
      test(load, change[0], unloaded);
      break;
  }
  return exit;
}

template <int D>
void ProximalStep<D>::move(double length, std::span<const Motion<D>> direction) {
  for (std::size_t u = 0; u < y_.size(); ++u)
    for (std::size_t k = 0; k < y_[u].size(); ++k) y_[u][k] += length * direction[u][k];
  for (std::size_t r = 0; r < values_.size(); ++r) values_[r] += length * changes_[r];
}

template <int D>
double ProximalStep<D>::follow_path(int& iterations) {
  const auto count = static_cast<Eigen::Index>(kMostCrossings);
  std::vector<Crossing> crossings;
  std::vector<std::vector<Motion<D>>> moved;       // matrix^-1 J^T column of each crossing
  Eigen::MatrixXd changes(count, count);           // I + products of rows of crossings and `moved`
  const auto first = matrix_.solution_of(error_);  // direction of the first piece
  auto best_y = y_;
  auto best_values = values_;
  // The path is followed so that `share` grows on pieces whose matrix has a positive determinant,
  // and falls where it is negative. This leads to a solution, because the topological degree of the
  // equation is 1.
  double share = 0, best = 0, sign = matrix_.sign_of_determinant();
  for (Eigen::Index n = 0;; ++n) {
    // The matrix of this piece is that of the factors plus the crossings (Sherman & Morrison 1950).
    direction_ = first;
    const auto small = changes.topLeftCorner(n, n).partialPivLu();
    if (n > 0) {
      Eigen::VectorXd right(n);
      for (Eigen::Index i = 0; i < n; ++i)
        right[i] = product(crossings[static_cast<std::size_t>(i)], first);
      const Eigen::VectorXd weights = small.solve(right);
      if (!weights.allFinite()) break;
      for (Eigen::Index i = 0; i < n; ++i)
        for (std::size_t u = 0; u < direction_.size(); ++u)
          for (std::size_t k = 0; k < direction_[u].size(); ++k)
            direction_[u][k] -= weights[i] * moved[static_cast<std::size_t>(i)][u][k];
    }
    for (std::size_t r = 0; r < changes_.size(); ++r) changes_[r] = problem_.product(r, direction_);
    Exit exit;
    std::size_t block = 0;
    for (std::size_t b = 0; b < problem_.blocks.size(); ++b)
      if (const auto of_block = exit_of(b, sign); of_block.length < exit.length) {
        exit = of_block;
        block = b;
      }
    if (sign > 0 && share + exit.length >= 1) {
      move(1 - share, direction_);
      return 1;
    }
    if (n == count || !std::isfinite(exit.length)) break;
    ++iterations;
    share += sign * exit.length;
    move(sign * exit.length, direction_);
    if (share > best) {
      best = share;
      best_y = y_;
      best_values = values_;
    }
    const auto crossing = crossing_to(block, exit.branch);
    branches_[block] = exit.branch;
    std::vector<Motion<D>> column(y_.size(), Motion<D>{});
    for (std::size_t k = 0; k < 2; ++k)
      if (crossing.column[k] != 0)
        problem_.add_impulse(problem_.blocks[block].row + k, crossing.column[k], column);
    crossings.push_back(crossing);
    moved.push_back(matrix_.solution_of(column));
    for (Eigen::Index i = 0; i <= n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      changes(i, n) = product(crossings[k], moved.back()) + (i == n ? 1 : 0);
      changes(n, i) = product(crossing, moved[k]) + (i == n ? 1 : 0);
    }
    // The crossing multiplies the determinant by `ratio`. If its sign changes, the path turns back.
    double ratio = changes(n, n);
    if (n > 0) ratio -= changes.row(n).head(n).dot(small.solve(changes.col(n).head(n)));
    if (ratio < 0) sign = -sign;
  }
  y_ = std::move(best_y);
  values_ = std::move(best_values);
  return best;
}

template double ProximalStep<2>::follow_path(int&);
template void ProximalStep<2>::move(double, std::span<const Motion<2>>);
template void ProximalStep<3>::move(double, std::span<const Motion<3>>);

}  // namespace viscontact::contact_solver
