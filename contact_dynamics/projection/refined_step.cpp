// The refinement of the impulses of a step without friction, bodies and links.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "viscontact/constraint_rows/contact_rows.hpp"
#include "viscontact/contact_dynamics/projection/step_projection.hpp"
#include "viscontact/contact_solver/refinement.hpp"

namespace viscontact::particles {

template <int D>
void StepProjection<D>::refine() {
  errors_.assign(system_.contacts.size(), {});
  const auto& bodies = system_.bodies();
  std::vector<std::int32_t> number(bodies.size(), -1);  // of the islands, at their roots
  std::vector<std::vector<std::size_t>> islands;        // their contacts
  for (std::size_t c = 0; c < system_.contacts.size(); ++c) {
    auto& n = number[index_of(system_.island(system_.body_of(system_.contacts[c].second)))];
    if (n < 0) {
      n = static_cast<std::int32_t>(islands.size());
      islands.emplace_back();
    }
    islands[index_of(n)].push_back(c);
  }
  std::vector<std::int32_t> unit_of(bodies.size(), -1);
  for (const auto& island : islands) {
    // The residual of a single contact is the error of its impulse.
    if (island.size() == 1 || !is_worth_refining(island)) continue;
    ConstraintProblem<D> problem;
    std::vector<std::int32_t> particles;  // of the units
    const auto unit = [&](std::int32_t particle) {
      auto& u = unit_of[index_of(system_.body_of(particle))];
      if (u >= 0) return u;
      u = static_cast<std::int32_t>(particles.size());
      particles.push_back(particle);
      constexpr std::array<double, 3> kNoTurn{};
      const double mobility = mobilities_[index_of(particle)];
      problem.units.push_back(unit_of_particle<D>(
          mobility, mobility, system_.free_displacement(index_of(system_.body_of(particle))),
          kNoTurn.data()));
      return u;
    };
    for (const auto c : island) {
      const auto& contact = system_.contacts[c];
      Motion<D> along{}, against{};
      for (std::size_t d = 0; d < D; ++d) {
        along[d] = contact.normal[d];
        against[d] = -contact.normal[d];
      }
      ConstraintBlock block;
      block.row = problem.rows.size();
      block.lowest = contact.lowest;
      block.allowed = contact.allowed;
      problem.blocks.push_back(block);
      const RowPart<D> of_second{unit(contact.second), along};
      if (contact.first_entry() < 0)
        problem.add_row(contact.gap, std::array{of_second}, contact.impulse);
      else
        problem.add_row(contact.gap,
                        std::array{of_second, RowPart<D>{unit(contact.first_entry()), against}},
                        contact.impulse);
    }
    ConstraintSolution<D> solution;
    solution.motions = motions<D>(problem, problem.impulses);
    for (const auto& block : problem.blocks)
      solution.residuals.push_back(residual_after<D>(problem, block, solution.motions));
    const Refinement<D> refinement(problem, solution);
    for (const auto particle : particles) unit_of[index_of(system_.body_of(particle))] = -1;
    if (!refinement.is_done()) continue;
    std::vector<double> rounding;
    for (const auto c : island) rounding.push_back(rounding_[c]);
    const auto unavoidable = refinement.changes_by(rounding);
    for (std::size_t b = 0; b < island.size(); ++b) {
      system_.contacts[island[b]].impulse = problem.impulses[b];
      errors_[island[b]] = {refinement.error(b), unavoidable[b]};
    }
    for (std::size_t u = 0; u < particles.size(); ++u)
      for (std::size_t d = 0; d < D; ++d)
        displacements_[index_of(particles[u]) * D + d] = solution.motions[u][d];
  }
}

template <int D>
bool StepProjection<D>::is_worth_refining(const std::vector<std::size_t>& island) {
  if (island.size() <= Refinement<D>::kMany) return true;
  std::size_t pairs = 0;
  double least = std::numeric_limits<double>::infinity(), largest = 0;
  for (const auto c : island) {
    const auto& contact = system_.contacts[c];
    pairs += contact.first_entry() >= 0 ? 1 : 0;
    for (const auto particle : {contact.first_entry(), contact.second}) {
      if (particle < 0) continue;
      least = std::min(least, mobilities_[index_of(particle)]);
      largest = std::max(largest, mobilities_[index_of(particle)]);
    }
  }
  const auto root = system_.island(system_.body_of(system_.contacts[island.front()].second));
  return (pairs < system_.size_of_island(root) || island.size() <= Refinement<D>::kMost) &&
         largest > Refinement<D>::kDifferent * least;
}

template <int D>
std::vector<typename StepProjection<D>::Understated> StepProjection<D>::understated() {
  std::vector<double> least(system_.bodies().size(), std::numeric_limits<double>::infinity());
  const auto root = [&](const auto& contact) {
    return system_.island(system_.body_of(contact.second));
  };
  for (const auto& contact : system_.contacts)
    for (const auto particle : {contact.first_entry(), contact.second})
      if (particle >= 0 && mobilities_[index_of(particle)] > 0) {
        auto& of_island = least[index_of(root(contact))];
        of_island = std::min(of_island, mobilities_[index_of(particle)]);
      }
  std::vector<Understated> factors;
  for (const auto& contact : system_.contacts) {
    double mobility = mobilities_[index_of(contact.second)];
    if (contact.first_entry() >= 0)
      mobility = std::max(mobility, mobilities_[index_of(contact.first_entry())]);
    const auto size = static_cast<double>(system_.size_of_island(root(contact)));
    factors.push_back({std::max(1.0, mobility / least[index_of(root(contact))]),
                       D == 2 ? size : std::cbrt(size * size)});
  }
  return factors;
}

template <int D>
ImpulseError StepProjection<D>::error_of_contact(std::size_t c) const {
  if (constraints_) return constraints_->impulse_error(c);
  return c < errors_.size() ? errors_[c] : ImpulseError{};
}

template bool StepProjection<2>::is_worth_refining(const std::vector<std::size_t>&);
template bool StepProjection<3>::is_worth_refining(const std::vector<std::size_t>&);
template void StepProjection<2>::refine();
template void StepProjection<3>::refine();
template std::vector<StepProjection<2>::Understated> StepProjection<2>::understated();
template std::vector<StepProjection<3>::Understated> StepProjection<3>::understated();
template ImpulseError StepProjection<2>::error_of_contact(std::size_t) const;
template ImpulseError StepProjection<3>::error_of_contact(std::size_t) const;

}  // namespace viscontact::particles
