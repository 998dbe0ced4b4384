// Products and residuals of the constraints of a step (constraint_problem.hpp).
#include "viscontact/particles/constraints/constraint_problem.hpp"

#include <algorithm>
#include <cmath>

#include "viscontact/particles/contact/contact.hpp"

namespace viscontact::particles {

template <int D>
std::vector<Motion<D>> motions(const ConstraintProblem<D>& problem,
                               std::span<const double> impulses) {
  std::vector<Motion<D>> sums(problem.units.size(), Motion<D>{});
  for (std::size_t r = 0; r < problem.rows.size(); ++r)
    if (impulses[r] != 0) add_impulse<D>(problem.rows[r], impulses[r], sums);
  for (std::size_t b = 0; b < sums.size(); ++b) {
    const auto& unit = problem.units[b];
    sums[b] = unit.moved_by(sums[b]);
    for (std::size_t k = 0; k < sums[b].size(); ++k) sums[b][k] += unit.free[k];
  }
  return sums;
}

template <int D>
std::vector<double> row_mobilities(const ConstraintProblem<D>& problem) {
  std::vector<double> w;
  w.reserve(problem.rows.size());
  for (const auto& row : problem.rows) {
    const auto share = [&](std::int32_t unit, const Motion<D>& of) {
      if (unit < 0) return 0.0;
      const auto moved = problem.units[static_cast<std::size_t>(unit)].moved_by(of);
      double sum = 0;
      for (std::size_t k = 0; k < of.size(); ++k) sum += of[k] * moved[k];
      return sum;
    };
    w.push_back(share(row.first, row.of_first) + share(row.second, row.of_second));
  }
  return w;
}

FrictionCone FrictionCone::nearest(double mu_s, double p_s, double length, double w_n, double w_t) {
  if (length <= mu_s * p_s) return {Part::kInside, p_s, 1};
  const double load = (w_n * p_s + w_t * mu_s * length) / (w_n + w_t * mu_s * mu_s);
  if (!(load > 0)) return {Part::kApex, 0, 0};
  return {Part::kSurface, load, mu_s * load / length};
}

BlockResidual residual_of(const ConstraintBlock& block, bool lifts_sliding, const double* v,
                          const double* p, const double* w) {
  BlockResidual residual;
  if (!block.is_contact) {
    for (std::size_t k = 0; k < block.rows; ++k)
      residual.normal = std::max(residual.normal, std::abs(v[k] + block.compliance * p[k]));
    return residual;
  }
  double square = 0;
  const double bound = block.bound(p[0]);
  std::array<double, 2> wanted{};
  for (std::size_t k = 1; k < block.rows; ++k) {
    wanted[k - 1] = p[k] - v[k] / w[k];
    square += wanted[k - 1] * wanted[k - 1];
  }
  residual.normal = contact_residual(v[0], w[0] * (p[0] - block.lowest));
  double factor = square > bound * bound ? bound / std::sqrt(square) : 1;
  if (is_in_cone(block, lifts_sliding, p[0])) {
    const auto cone = FrictionCone::nearest(block.friction, p[0] - v[0] / w[0] - block.capacity,
                                            std::sqrt(square), w[0], w[1]);
    // At the apex nothing is left to the solids, and the condition of the film is the one that
    // counts.
    if (cone.part != FrictionCone::Part::kApex || block.capacity <= block.lowest)
      residual.normal = w[0] * std::abs(p[0] - block.capacity - cone.load);
    factor = cone.tangential;
  }
  double off = 0;
  for (std::size_t k = 1; k < block.rows; ++k) {
    const double difference = w[k] * (p[k] - factor * wanted[k - 1]);
    off += difference * difference;
  }
  residual.tangential = std::sqrt(off);
  return residual;
}

template std::vector<Motion<2>> motions<2>(const ConstraintProblem<2>&, std::span<const double>);
template std::vector<Motion<3>> motions<3>(const ConstraintProblem<3>&, std::span<const double>);
template std::vector<double> row_mobilities<2>(const ConstraintProblem<2>&);
template std::vector<double> row_mobilities<3>(const ConstraintProblem<3>&);

}  // namespace viscontact::particles
