#include "particles/step_projection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/error.hpp"
#include "particles/block_results.hpp"

namespace viscontact::particles {
namespace {

template <int D>
SolverMethod<D> method_of(const SolverSettings& settings) {
  for (const auto& row : kSolverMethods)
    if (row.name == settings.method) {
      if constexpr (D == 2)
        return row.discs;
      else
        return row.spheres;
    }
  throw Error(ExitCode::kBadInput, fmt::format("there is no method '{}'", settings.method));
}

/// Neighbours in the list share particles, so that in a sweep each contact would wait for the one before it. Three strands that are far from each other in
/// the list go side by side; measured on box2d: 1 to 6 strands take 8.4, 6.8, 6.4, 7.0, -, 7.2 ms a step. Within blocks, each of which has its own sweep.
std::vector<std::size_t> in_strands(const std::vector<std::size_t>& films) {
  constexpr std::size_t kStrands = 3;
  std::vector<std::size_t> order;
  order.reserve(films.size());
  for (std::size_t begin = 0; begin < films.size(); begin += Team::kBlock) {
    const std::size_t end = std::min(begin + Team::kBlock, films.size());
    const std::size_t strand = (end - begin + kStrands - 1) / kStrands;
    for (std::size_t k = begin; k < begin + strand; ++k)
      for (std::size_t f = k; f < end; f += strand) order.push_back(films[f]);
  }
  return order;
}

}  // namespace

template <int D>
StepProjection<D>::StepProjection(State& state, std::span<const PlanePlace> planes,
                                  std::span<double> displacements,
                                  std::span<const double> mobilities, Team& team)
    : state_(state),
      planes_(planes),
      displacements_(displacements),
      mobilities_(mobilities),
      team_(team),
      is_chosen_(films(), 0),
      number_(mobilities.size(), -1) {}

template <int D>
std::vector<std::size_t> StepProjection<D>::closed_by_free_motion() {
  return team_
      .sum_of_blocks<Joined<std::size_t>>(
          films(),
          [&](std::size_t begin, std::size_t end) {
            Joined<std::size_t> numbers;
            for (std::size_t f = begin; f < end; ++f) {
              const auto& now = film(f);
              if (now.gamma < 0 || now.impulse != 0 ||
                  gap_after(contact_of<D>(state_.particles, now, planes_), displacements_) < 0)
                numbers.values.push_back(f);
            }
            return numbers;
          })
      .values;
}

/// The films not yet chosen, of particles that take part, whose gap is now below -tolerance: others are as the free motion left them.
template <int D>
std::vector<std::size_t> StepProjection<D>::closed(double tolerance, Projected& result) {
  std::vector<std::size_t> closed;
  result.smallest_gap = 0;
  for (std::size_t f = 0; f < films(); ++f) {
    const auto& now = film(f);
    const bool takes_part = number_[static_cast<std::size_t>(now.second)] >= 0 ||
                            (now.first >= 0 && number_[static_cast<std::size_t>(now.first)] >= 0);
    if (!takes_part) continue;
    const double gap = gap_after(contact_of<D>(state_.particles, now, planes_), displacements_);
    result.smallest_gap = std::min(result.smallest_gap, gap);
    if (is_chosen_[f] != 0) continue;
    result.violation = std::max(result.violation, -gap);
    if (gap < -tolerance) closed.push_back(f);
  }
  return closed;
}

template <int D>
void StepProjection<D>::choose(const std::vector<std::size_t>& films) {
  const auto number_of = [&](std::int32_t particle) {
    auto& number = number_[static_cast<std::size_t>(particle)];
    if (number < 0) {
      number = static_cast<std::int32_t>(bodies_.size());
      bodies_.push_back(particle);
      const auto k = static_cast<std::size_t>(particle);
      free_.insert(free_.end(), &displacements_[k * D], &displacements_[k * D] + D);
      body_mobilities_.push_back(mobilities_[k]);
    }
    return number;
  };
  for (const auto f : in_strands(films)) {
    is_chosen_[f] = 1;
    auto contact = contact_of<D>(state_.particles, film(f), planes_);
    if (contact.first >= 0) contact.first = number_of(contact.first);
    contact.second = number_of(contact.second);
    contacts_.push_back(contact);
    chosen_.push_back(f);
  }
}

template <int D>
Solved StepProjection<D>::solve(const SolverSettings& settings, double goal, int iterations) {
  ContactGraph<D> graph(contacts_, free_, body_mobilities_, team_);
  const auto solved = method_of<D>(settings)(graph, goal, iterations, factor_);
  std::vector<double> moved(graph.bodies() * D), impulses(contacts_.size());
  graph.to_bodies(graph.z, moved);
  graph.impulses(impulses);
  for (std::size_t c = 0; c < contacts_.size(); ++c) contacts_[c].impulse = impulses[c];
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    for (std::size_t d = 0; d < D; ++d)
      displacements_[static_cast<std::size_t>(bodies_[b]) * D + d] =
          free_[b * D + d] + moved[b * D + d];
  return solved;
}

template <int D>
Projected StepProjection<D>::solve(const SolverSettings& settings, double mean_radius) {
  Projected result;
  choose(closed_by_free_motion());
  const double tolerance = settings.tolerance * mean_radius;
  // Roughly at first: which other contacts these close is then known before much is spent. Measured: 1e-2 to 1e-4 take as long, none a third longer.
  constexpr double kRough = 1e-3;
  bool rough = settings.tolerance < kRough;
  while (!chosen_.empty()) {
    const auto solved = solve(settings, rough ? kRough * mean_radius : tolerance,
                              settings.max_iterations - result.iterations);
    result.iterations += solved.iterations;
    result.violation = solved.violation;
    auto more = closed(tolerance, result);
    if (result.iterations >= settings.max_iterations || (more.empty() && !rough)) break;
    if (more.empty()) rough = false;
    choose(more);
  }
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    film(chosen_[c]).impulse = contacts_[c].impulse;
    result.films.push_back(&film(chosen_[c]));
  }
  result.bodies = std::move(bodies_);
  return result;
}

template class StepProjection<2>;
template class StepProjection<3>;

}  // namespace viscontact::particles
