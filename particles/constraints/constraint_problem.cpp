// Motions, mobilities, residuals and rows of contacts of (5.6) to (5.9), docs/physics.md.
#include "viscontact/particles/constraints/constraint_problem.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/particles/contact/contact.hpp"

namespace viscontact::particles {

template <int D>
RigidUnit<D> unit_of_particle(double mobility, double turn_mobility, const double* displacement,
                              const double* turn) {
  assert(mobility > 0 && turn_mobility > 0);
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  RigidUnit<D> unit;
  unit.mobility = mobility;
  unit.inverse_mobility = 1 / mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = displacement[i];
  for (std::size_t i = 0; i < r; ++i) {
    unit.free[d + i] = turn[i];
    unit.turn_mobility[i * r + i] = turn_mobility;
    unit.inverse_turn_mobility[i * r + i] = 1 / turn_mobility;
  }
  return unit;
}

template <int D>
RigidUnit<D> unit_of_body(const BodyStep& free) {
  assert(free.mobility > 0);
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  RigidUnit<D> unit;
  unit.mobility = free.mobility;
  unit.inverse_mobility = 1 / free.mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = free.displacement[i];
  // A disc turns about z only, the last of the three axes of BodyStep.
  for (std::size_t i = 0; i < r; ++i) {
    unit.free[d + i] = free.turn[3 - r + i];
    for (std::size_t k = 0; k < r; ++k) {
      const std::size_t at = 3 * (3 - r + i) + 3 - r + k;
      unit.turn_mobility[i * r + k] = free.turn_mobility[at];
      unit.inverse_turn_mobility[i * r + k] = free.inverse_turn_mobility[at];
    }
  }
  return unit;
}

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
    block.given_load = FrictionLaw::carried(problem.impulses[block.row], block.capacity);
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

template RigidUnit<2> unit_of_particle<2>(double, double, const double*, const double*);
template RigidUnit<3> unit_of_particle<3>(double, double, const double*, const double*);
template RigidUnit<2> unit_of_body<2>(const BodyStep&);
template RigidUnit<3> unit_of_body<3>(const BodyStep&);
template std::vector<Motion<2>> motions<2>(const ConstraintProblem<2>&, std::span<const double>);
template std::vector<Motion<3>> motions<3>(const ConstraintProblem<3>&, std::span<const double>);
template void give_loads<2>(ConstraintProblem<2>&);
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

namespace {

/// Unit vectors that complete `normal` to a right-handed basis. They depend continuously on the
/// normal, except where another component of a normal in space becomes the smallest one.
template <int D>
std::array<Vector, static_cast<std::size_t>(D - 1)> tangent_basis(const Vector& normal) {
  if constexpr (D == 2) {
    return {Vector{-normal[1], normal[0], 0}};
  } else {
    std::size_t least = 0;
    for (std::size_t d = 1; d < 3; ++d)
      if (std::abs(normal[d]) < std::abs(normal[least])) least = d;
    Vector axis{};
    axis[least] = 1;
    const Vector across = cross(normal, axis);
    const Vector first = (1 / norm(across)) * across;
    return {first, cross(normal, first)};
  }
}

template <int D>
Vector normal_of(const Contact<D>& contact) {
  Vector normal{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d) normal[d] = contact.normal[d];
  return normal;
}

}  // namespace

template <int D>
ContactTangents<D> tangents_of(const Contact<D>& contact, const Particles& particles,
                               std::span<const Plane> obstacles, double begin, double end) {
  assert(contact.first >= 0 || static_cast<std::size_t>(contact.obstacle) < obstacles.size());
  ContactTangents<D> tangents;
  const auto j = index_of(contact.second);
  const Vector normal = normal_of(contact);
  tangents.directions = tangent_basis<D>(normal);
  const double r_j = particles.radii[j];
  tangents.second_arm = r_j;
  if (contact.first >= 0) {
    // The arms are in the ratio of the radii and add up to the distance of the centres, also if the
    // gap is not 0. Opposite impulses at their common end do not change the angular momentum.
    const double r_i = particles.radii[index_of(contact.first)];
    const double distance = r_i + r_j + contact.gap - contact.tolerated;
    tangents.first_arm = r_i * (distance / (r_i + r_j));
    tangents.second_arm = r_j * (distance / (r_i + r_j));
  } else {
    const auto& obstacle = obstacles[static_cast<std::size_t>(contact.obstacle)];
    const Vector point = particles.position(j) - (r_j + contact.gap) * normal;
    tangents.surface = obstacle.displacement(point, begin, end);
  }
  return tangents;
}

template <int D>
void add_contact_row(const Contact<D>& contact, const ContactTangents<D>& tangents,
                     const ContactSide& first, const ContactSide& second, std::size_t k,
                     double impulse, ConstraintProblem<D>& problem) {
  assert(k < static_cast<std::size_t>(D));
  const Vector normal = normal_of(contact);
  const Vector direction = k == 0 ? normal : tangents.directions[k - 1];
  double offset = k == 0 ? contact.gap : 0 - dot(direction, tangents.surface);
  std::array<RowPart<D>, 2> parts;
  std::size_t count = 0;
  const auto add = [&](const ContactSide& side, const Vector& along, const Vector& arm) {
    if (side.unit >= 0)
      parts[count++] = {side.unit, displacement_row<D>(along, arm)};
    else
      offset += dot(along, side.displacement + cross(side.turn, arm));
  };
  add(second, direction, second.offset - tangents.second_arm * normal);
  const bool is_along_plane = contact.loaded_plane >= 0 && k > 0;
  add(first, is_along_plane ? Vector{} : -1 * direction,
      first.offset + tangents.first_arm * normal);
  problem.add_row(offset, std::span(parts).first(count), impulse);
}

template ContactTangents<2> tangents_of<2>(const Contact<2>&, const Particles&,
                                           std::span<const Plane>, double, double);
template ContactTangents<3> tangents_of<3>(const Contact<3>&, const Particles&,
                                           std::span<const Plane>, double, double);
template void add_contact_row<2>(const Contact<2>&, const ContactTangents<2>&, const ContactSide&,
                                 const ContactSide&, std::size_t, double, ConstraintProblem<2>&);
template void add_contact_row<3>(const Contact<3>&, const ContactTangents<3>&, const ContactSide&,
                                 const ContactSide&, std::size_t, double, ConstraintProblem<3>&);

}  // namespace viscontact::particles
