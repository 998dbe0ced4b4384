// Motions, mobilities, residuals and rows of contacts of (5.6) to (5.9), docs/physics.md.
#include "viscontact/contact_solver/problem/constraint_problem.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::contact_solver {

template <int D>
std::vector<Motion<D>> motions(const ConstraintProblem<D>& problem,
                               std::span<const double> impulses) {
  assert(impulses.size() == problem.rows.size());
  std::vector<Motion<D>> sums(problem.units.size(), Motion<D>{});
  for (std::size_t r = 0; r < problem.rows.size(); ++r)
    if (impulses[r] != 0) problem.add_impulse(r, impulses[r], sums);
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const auto& unit = problem.units[b];
    sums[b] = unit.moved_by(sums[b]);
    for (std::size_t k = 0; k < sums[b].size(); ++k) sums[b][k] += unit.free[k];
  }
  return sums;
}

template <int D>
void give_loads(ConstraintProblem<D>& problem) {
  problem.is_convex = problem.keeps_loads = true;
  problem.is_rough = false;
  for (auto& block : problem.blocks) {
    if (!block.is_contact || block.rows == 1) continue;
    block.friction_bound = FrictionBound::kGiven;
    block.is_optional = false;
    block.given_load = load_of_solids(problem.impulses[block.row], block.capacity);
  }
}

template <int D>
void bind_optional(ConstraintProblem<D>& problem) {
  for (auto& block : problem.blocks) {
    if (!block.is_optional || problem.impulses[block.row] != 0) continue;
    block.is_optional = false;
    if (!block.is_in_cone()) continue;
    block.friction_bound = FrictionBound::kGiven;
    block.given_load = 0;
  }
}

/// The change of the value of row `r` by a unit impulse on row `s` of the same block [T/M].
template <int D>
double mobility_between(const ConstraintProblem<D>& problem, std::size_t r, std::size_t s) {
  const auto of_r = problem.parts_of(r), of_s = problem.parts_of(s);
  assert(of_r.size() == of_s.size());
  double sum = 0;
  for (std::size_t part = 0; part < of_r.size(); ++part) {
    const auto& unit = problem.units[static_cast<std::size_t>(of_s[part].unit)];
    const auto moved = unit.moved_by(of_s[part].coefficients);
    double share = 0;
    for (std::size_t k = 0; k < moved.size(); ++k) share += of_r[part].coefficients[k] * moved[k];
    sum += share;
  }
  return sum;
}

template <int D>
std::array<double, kMostRows> block_mobilities(const ConstraintProblem<D>& problem,
                                               const ConstraintBlock& block) {
  assert(block.rows >= 1 && block.rows <= kMostRows);
  std::array<double, kMostRows> w{};
  for (std::size_t k = 0; k < block.rows; ++k)
    w[k] = mobility_between(problem, block.row + k, block.row + k);
  if (block.is_contact && block.rows == 3) {
    const double beside = mobility_between(problem, block.row + 1, block.row + 2);
    w[1] = w[2] = (w[1] + w[2]) / 2 + std::hypot((w[1] - w[2]) / 2, beside);
  }
  return w;
}

template <int D>
std::vector<double> row_mobilities(const ConstraintProblem<D>& problem) {
  std::vector<double> w(problem.rows.size());
  for (const auto& block : problem.blocks)
    std::ranges::copy_n(block_mobilities(problem, block).begin(),
                        static_cast<std::ptrdiff_t>(block.rows), &w[block.row]);
  return w;
}

BlockResidual residual_of(const ConstraintBlock& block, const double* v, const double* p,
                          const double* w, double rounding) {
  assert(block.rows >= 1 && block.rows <= kMostRows);
  BlockResidual residual;
  const auto least = [&](std::size_t k) { return rounding * w[k] * std::abs(p[k]); };
  if (!block.is_contact) {
    for (std::size_t k = 0; k < block.rows; ++k)
      residual.normal = largest_or_nan(
          residual.normal, std::max(std::abs(v[k] + block.compliance * p[k]), least(k)));
    return residual;
  }
  const auto is_zero = [](double impulse) { return impulse == 0; };
  if (block.is_optional && std::all_of(p, p + block.rows, is_zero)) {
    residual.normal = largest_or_nan(0, -v[0]);
    return residual;
  }
  double square = 0;
  std::array<double, 2> wanted{};
  for (std::size_t k = 1; k < block.rows; ++k) {
    wanted[k - 1] = p[k] - v[k] / w[k];
    square += wanted[k - 1] * wanted[k - 1];
  }
  residual.normal = contact_residual(v[0], w[0] * (p[0] - block.lowest));
  double factor = 1;
  if (block.is_in_cone()) {
    const auto cone =
        FrictionCone::nearest(block.friction, p[0] - v[0] / w[0], std::sqrt(square), w[0], w[1]);
    residual.normal = w[0] * std::abs(p[0] - cone.load);
    factor = cone.tangential;
  } else if (const double bound = block.bound(p[0]); square > bound * bound) {
    factor = bound / std::sqrt(square);
  }
  double off = 0;
  for (std::size_t k = 1; k < block.rows; ++k) {
    const double difference = w[k] * (p[k] - factor * wanted[k - 1]);
    off += difference * difference;
  }
  residual.tangential = std::sqrt(off);
  residual.normal = largest_or_nan(residual.normal, least(0));
  for (std::size_t k = 1; k < block.rows; ++k)
    residual.tangential = largest_or_nan(residual.tangential, least(k));
  return residual;
}

template <int D>
BlockResidual residual_after(const ConstraintProblem<D>& problem, const ConstraintBlock& block,
                             std::span<const Motion<D>> motions) {
  assert(block.row + block.rows <= problem.impulses.size());
  std::array<double, kMostRows> v{};
  for (std::size_t k = 0; k < block.rows; ++k)
    v[k] = problem.rows[block.row + k].offset + problem.product(block.row + k, motions);
  const auto w = block_mobilities(problem, block);
  return residual_of(block, v.data(), &problem.impulses[block.row], w.data());
}

template std::vector<Motion<2>> motions<2>(const ConstraintProblem<2>&, std::span<const double>);
template std::vector<Motion<3>> motions<3>(const ConstraintProblem<3>&, std::span<const double>);
template void give_loads<2>(ConstraintProblem<2>&);
template void bind_optional<2>(ConstraintProblem<2>&);
template void bind_optional<3>(ConstraintProblem<3>&);
template void give_loads<3>(ConstraintProblem<3>&);
template std::array<double, kMostRows> block_mobilities<2>(const ConstraintProblem<2>&,
                                                           const ConstraintBlock&);
template std::array<double, kMostRows> block_mobilities<3>(const ConstraintProblem<3>&,
                                                           const ConstraintBlock&);
template std::vector<double> row_mobilities<2>(const ConstraintProblem<2>&);
template std::vector<double> row_mobilities<3>(const ConstraintProblem<3>&);
template BlockResidual residual_after<2>(const ConstraintProblem<2>&, const ConstraintBlock&,
                                         std::span<const Motion<2>>);
template BlockResidual residual_after<3>(const ConstraintProblem<3>&, const ConstraintBlock&,
                                         std::span<const Motion<3>>);

}  // namespace viscontact::contact_solver
