// The bodies and islands of (5.4), docs/physics.md.
#include "viscontact/contact_dynamics/constraints/contact_system.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace viscontact::particles {

template <int D>
std::int32_t ContactSystem<D>::number(std::int32_t particle) {
  assert(particle >= 0 && index_of(particle) < body_of_.size());
  const auto k = index_of(particle);
  if (body_of_[k] >= 0) return body_of_[k];
  body_of_[k] = static_cast<std::int32_t>(bodies_.size());
  bodies_.push_back(particle);
  free_.insert(free_.end(), &displacements_[k * D], &displacements_[k * D] + D);
  body_mobilities_.push_back(mobilities_[k]);
  island_of_.push_back(body_of_[k]);
  island_sizes_.push_back(1);
  const auto rigid = particles_.bodies.body_of(particle);
  const bool is_round = k >= particles_.count() || particles_.is_round(k);
  has_finite_turns_.push_back(rigid < 0 && is_round ? 0 : 1);
  uses_distances_.push_back(0);
  if (rigid >= 0)
    for (const auto member : particles_.bodies.bodies[index_of(rigid)].members)
      if (body_of_[index_of(member)] < 0) connect(particle, member);
  return body_of_[k];
}

template <int D>
void ContactSystem<D>::connect(std::int32_t first, std::int32_t second) {
  const auto b = number(second);
  if (first < 0) return;
  const auto a = number(first);
  join(island(a), island(b));
}

template <int D>
void ContactSystem<D>::add(const Contact<D>& contact) {
  contacts.push_back(contact);
  if (contact.first_entry() >= 0) number(contact.first_entry());
  connect(contact.first_entry(), contact.second);
}

template <int D>
std::int32_t ContactSystem<D>::island(std::int32_t body) {
  for (;;) {
    auto& of = island_of_[index_of(body)];
    if (of == body) return body;
    of = island_of_[index_of(of)];  // path halving: the parent becomes the grandparent
    body = of;
  }
}

template <int D>
void ContactSystem<D>::join(std::int32_t island, std::int32_t other) {
  if (island == other) return;
  auto& size = island_sizes_[index_of(other)];
  size += island_sizes_[index_of(island)];
  island_of_[index_of(island)] = other;
  has_finite_turns_[index_of(other)] |= has_finite_turns_[index_of(island)];
  uses_distances_[index_of(other)] |= uses_distances_[index_of(island)];
  largest_island_ = std::max(largest_island_, size);
}

template <int D>
bool ContactSystem<D>::has_mark(const Contact<D>& contact, const std::vector<char>& marks) {
  return std::ranges::any_of(std::array{contact.first, contact.second}, [&](std::int32_t particle) {
    const auto body = particle < 0 ? -1 : body_of(particle);
    return body >= 0 && marks[index_of(island(body))] != 0;
  });
}

template <int D>
bool ContactSystem<D>::has_finite_turns(const Contact<D>& contact) {
  return has_mark(contact, has_finite_turns_);
}

template <int D>
bool ContactSystem<D>::uses_distance(const Contact<D>& contact) {
  return has_distances_ && has_mark(contact, uses_distances_);
}

template <int D>
double ContactSystem<D>::gap(const Contact<D>& contact) {
  return gap(contact, uses_distance(contact));
}

template <int D>
double ContactSystem<D>::gap(const Contact<D>& contact, bool is_distance) const {
  if constexpr (D == 2)
    if (contact.shaped != nullptr)
      return gap_after_turns(contact, displacements_, turns_, is_distance);
  return is_distance ? distance_after(particles_, contact, displacements_)
                     : gap_after(contact, displacements_);
}

template <int D>
SolverResult ContactSystem<D>::solve(bool is_rough, int max_iterations, ThreadPool& pool) {
  std::vector<GapRow<D>> rows;
  rows.reserve(contacts.size());
  for (const auto& contact : contacts) {
    const auto first = contact.first_entry();
    rows.push_back({first < 0 ? -1 : body_of(first), body_of(contact.second), contact.normal,
                    contact.gap, bounds_of(contact)});
  }
  MassDualProblem<D> problem(rows, free_, body_mobilities_, pool);
  problem.largest_island = largest_island_;
  problem.is_rough = is_rough;
  const auto solved = solve_dual_problem(problem, max_iterations, factor_);
  std::vector<double> moved(problem.displacement_count());
  problem.to_bodies(problem.z, moved);
  for (std::size_t c = 0; c < contacts.size(); ++c) contacts[c].impulse = problem.impulse(c);
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t d = 0; d < D; ++d)
      displacements_[index_of(bodies_[b]) * D + d] = free_[b * D + d] + moved[b * D + d];
  return solved;
}

template class ContactSystem<2>;
template class ContactSystem<3>;

}  // namespace viscontact::particles
