// Makes the rows of contacts with friction, docs/physics.md (5.6), and writes back their solution.
#include "viscontact/particles/constraints/friction_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/particles/constraints/constraint_solver.hpp"

namespace viscontact::particles {
namespace {

/// Unit vectors that complete `normal` to a right-handed basis, without a jump unless the normal
/// changes its largest component.
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

/// Sets the part of a row that belongs to one particle: the displacement along `direction` of its
/// contact point, which is at `arm` [L] from the centre along `out`.
template <int D>
Motion<D> along(const Vector& direction, const Vector& arm) {
  Motion<D> row{};
  for (std::size_t d = 0; d < static_cast<std::size_t>(D); ++d) row[d] = direction[d];
  const Vector moment = cross(arm, direction);
  if constexpr (D == 2)
    row[2] = moment[2];
  else
    for (std::size_t d = 0; d < 3; ++d) row[3 + d] = moment[d];
  return row;
}

}  // namespace

template <int D>
FrictionSystem<D>::FrictionSystem(const FrictionStep& step, const Particles& particles,
                                  std::span<double> displacements,
                                  std::span<const double> mobilities)
    : step_(step),
      particles_(particles),
      displacements_(displacements),
      mobilities_(mobilities),
      free_turns_(step.turns.begin(), step.turns.end()) {}

template <int D>
typename FrictionSystem<D>::Tangents FrictionSystem<D>::tangents_of(
    const Contact<D>& contact) const {
  Tangents tangents;
  const auto j = index_of(contact.second);
  const Vector normal = normal_of(contact);
  tangents.directions = tangent_basis<D>(normal);
  const double r_j = particles_.radii[j];
  double r_i = std::numeric_limits<double>::infinity();
  tangents.second_arm = r_j;
  if (contact.first >= 0) {
    // The arms add up to the distance of the centres, so that the impulses of the pair keep the
    // angular momentum also while the gap is open.
    r_i = particles_.radii[index_of(contact.first)];
    const double distance = r_i + r_j + contact.gap - contact.tolerated;
    tangents.first_arm = r_i * (distance / (r_i + r_j));
    tangents.second_arm = r_j * (distance / (r_i + r_j));
  } else {
    const auto& obstacle = step_.obstacles[static_cast<std::size_t>(contact.obstacle)];
    const Vector point = particles_.position(j) - (r_j + contact.gap) * normal;
    tangents.surface = obstacle.displacement(point, step_.begin, step_.end);
  }
  tangents.capacity = contact.gamma - step_.law.lower_bound(r_j, r_i);
  return tangents;
}

template <int D>
void FrictionSystem<D>::add(const Contact<D>& contact, const Vector& friction) {
  tangents_.push_back(tangents_of(contact));
  frictions_.push_back(friction);
  residuals_.emplace_back();
}

template <int D>
RigidUnit<D> FrictionSystem<D>::unit_of(std::int32_t particle, const double* free) const {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  const auto k = index_of(particle);
  RigidUnit<D> unit;
  unit.mobility = mobilities_[k];
  unit.inverse_mobility = 1 / unit.mobility;
  for (std::size_t i = 0; i < d; ++i) unit.free[i] = free[i];
  for (std::size_t i = 0; i < r; ++i) {
    unit.free[d + i] = free_turns_[k * r + i];
    unit.turn_mobility[i * r + i] = step_.turn_mobilities[k];
    unit.inverse_turn_mobility[i * r + i] = 1 / step_.turn_mobilities[k];
  }
  return unit;
}

template <int D>
void FrictionSystem<D>::add_contact(const Contact<D>& contact, std::size_t c,
                                    const ContactSystem<D>& system, double allowed_slip,
                                    ConstraintProblem<D>& problem) const {
  const auto& tangents = tangents_[c];
  const Vector normal = normal_of(contact);
  ConstraintBlock block;
  block.row = problem.rows.size();
  block.lowest = contact.gamma;
  block.friction = step_.friction.coefficient;
  block.capacity = tangents.capacity;
  block.allowed = contact.allowed;
  block.allowed_slip = allowed_slip;
  // A film that no impulse of this step can use up leaves no friction, and needs no rows for it.
  const bool rubs = block.friction > 0 && std::isfinite(block.capacity);
  block.rows = rubs ? static_cast<std::size_t>(D) : 1;
  problem.blocks.push_back(block);
  for (std::size_t k = 0; k < block.rows; ++k) {
    const Vector direction = k == 0 ? normal : tangents.directions[k - 1];
    ConstraintRow<D> row;
    row.second = system.body_of(contact.second);
    row.of_second = along<D>(direction, -tangents.second_arm * normal);
    if (contact.first >= 0) {
      row.first = system.body_of(contact.first);
      row.of_first = along<D>(-1 * direction, tangents.first_arm * normal);
    }
    row.offset = k == 0 ? contact.gap : 0 - dot(direction, tangents.surface);
    problem.rows.push_back(row);
    problem.impulses.push_back(k == 0 ? contact.impulse : dot(direction, frictions_[c]));
  }
}

template <int D>
SolverResult FrictionSystem<D>::solve(ContactSystem<D>& system, bool is_rough, double allowed_slip,
                                      int max_iterations) {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  ConstraintProblem<D> problem;
  problem.lifts_sliding = step_.friction.method == FrictionMethod::kConvex;
  for (std::size_t b = 0; b < system.bodies().size(); ++b)
    problem.units.push_back(unit_of(system.bodies()[b], system.free_displacement(b)));
  for (std::size_t c = 0; c < system.contacts.size(); ++c)
    add_contact(system.contacts[c], c, system, allowed_slip, problem);
  // Before the impulses are roughly known, nothing is known about the impulses at work.
  if (is_rough)
    for (auto& block : problem.blocks) block.allowed = allowed_slip;
  const auto solution = solve_constraints(problem, max_iterations);
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    const auto& block = problem.blocks[c];
    system.contacts[c].impulse = problem.impulses[block.row];
    frictions_[c] = {};
    for (std::size_t k = 1; k < block.rows; ++k)
      frictions_[c] =
          frictions_[c] + problem.impulses[block.row + k] * tangents_[c].directions[k - 1];
    residuals_[c] = solution.residuals[c];
  }
  for (std::size_t b = 0; b < system.bodies().size(); ++b) {
    const auto k = index_of(system.bodies()[b]);
    const auto& motion = solution.motions[b];
    for (std::size_t i = 0; i < d; ++i) displacements_[k * d + i] = motion[i];
    for (std::size_t i = 0; i < r; ++i) step_.turns[k * r + i] = motion[d + i];
  }
  return solution.result;
}

template class FrictionSystem<2>;
template class FrictionSystem<3>;

}  // namespace viscontact::particles
