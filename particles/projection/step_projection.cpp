// Chooses the contacts of a step, solves the projection in rounds, and measures residuals
// (step_projection.hpp). Lengths, masses and times are in the units of the case.
#include "viscontact/particles/projection/step_projection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/common/system/block_results.hpp"

namespace viscontact::particles {
namespace {

/// Puts pairs in an order in which a sweep is fast. Neighbours in the list share particles, so that
/// in a sweep each contact would wait for the result of the contact before it. This order takes
/// contacts from three distant parts of the list in turn, within each block of the thread pool. On
/// box2d, 1, 2, 3, 4 and 6 parts take 8.4, 6.8, 6.4, 7.0 and 7.2 ms a step.
std::vector<std::size_t> interleaved(const std::vector<std::size_t>& films) {
  constexpr std::size_t kInterleaved = 3;
  std::vector<std::size_t> order;
  order.reserve(films.size());
  for (std::size_t begin = 0; begin < films.size(); begin += ThreadPool::kBlock) {
    const std::size_t end = std::min(begin + ThreadPool::kBlock, films.size());
    const std::size_t strand = (end - begin + kInterleaved - 1) / kInterleaved;
    for (std::size_t k = begin; k < begin + strand; ++k)
      for (std::size_t f = k; f < end; f += strand) order.push_back(films[f]);
  }
  return order;
}

}  // namespace

template <int D>
StepProjection<D>::StepProjection(State& state, double h, std::span<const PlanePosition> planes,
                                  std::span<double> displacements,
                                  std::span<const double> mobilities, ThreadPool& pool)
    : state_(state),
      h_(h),
      planes_(planes),
      displacements_(displacements),
      mobilities_(mobilities),
      pool_(pool),
      is_chosen_(films(), 0),
      number_(mobilities.size(), -1) {}

template <int D>
Contact<D> StepProjection<D>::contact(std::size_t f) {
  return resolved_contact_of<D>(state_.particles, film(f), planes_, tolerated_);
}

/// True if the displacements close the gap of pair f.
template <int D>
bool StepProjection<D>::gap_would_close(std::size_t f) {
  if (film(f).first >= 0 && cannot_close<D>(state_.particles, film(f), displacements_))
    return false;
  const auto here = contact_of<D>(state_.particles, film(f), planes_);
  const double gap = gap_after(here, displacements_);
  // Rounding errors matter only for gaps that are nearly 0. This test finds the others at less
  // cost; 1e-12 of the positions is far above the rounding errors of resolved_contact_of().
  constexpr double kNear = 1e-12;
  if (gap > 0) {
    const auto& p = state_.particles;
    const auto j = static_cast<std::size_t>(here.second);
    double size = p.radii[j] + std::abs(here.gap);
    for (std::size_t d = 0; d < D; ++d) size += std::abs(p.positions[j * D + d]);
    if (here.first >= 0) size += p.radii[static_cast<std::size_t>(here.first)];
    if (gap > kNear * size) return false;
  }
  return gap_after(contact(f), displacements_) < 0 &&
         paths_meet(state_.particles, here, displacements_);
}

template <int D>
std::vector<std::size_t> StepProjection<D>::closed_by_free_motion() {
  return pool_
      .sum_of_blocks<ConcatenatedBlocks<std::size_t>>(
          films(),
          [&](std::size_t begin, std::size_t end) {
            ConcatenatedBlocks<std::size_t> numbers;
            for (std::size_t f = begin; f < end; ++f) {
              const auto& now = film(f);
              if (now.gamma < 0 || now.impulse != 0 || gap_would_close(f))
                numbers.values.push_back(f);
            }
            return numbers;
          })
      .values;
}

/// Returns the root of the island of `body`: the body that stands for all bodies that chosen
/// contacts connect with it (union-find).
template <int D>
std::int32_t StepProjection<D>::island(std::int32_t body) {
  for (;;) {
    auto& of = island_of_[static_cast<std::size_t>(body)];
    if (of == body) return body;
    of = island_of_[static_cast<std::size_t>(of)];  // path halving
    body = of;
  }
}

template <int D>
void StepProjection<D>::join(std::int32_t island, std::int32_t other) {
  if (island == other) return;
  auto& size = island_sizes_[static_cast<std::size_t>(other)];
  size += island_sizes_[static_cast<std::size_t>(island)];
  island_of_[static_cast<std::size_t>(island)] = other;
  largest_island_ = std::max(largest_island_, size);
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
      island_of_.push_back(number);
      island_sizes_.push_back(1);
    }
    return number;
  };
  for (const auto f : interleaved(films)) {
    is_chosen_[f] = 1;
    auto now = contact(f);
    geometry_.push_back(now);
    if (now.first >= 0) now.first = number_of(now.first);
    now.second = number_of(now.second);
    if (now.first >= 0) join(island(now.first), island(now.second));
    contacts_.push_back(now);
    chosen_.push_back(f);
  }
}

/// Impulse at work on a particle that takes part in no other contact: the larger of what forces and
/// gravity give it in the step and of its change of momentum [M L/T]. `moves` is its
/// displacement h u* [L].
template <int D>
typename StepProjection<D>::ParticleScale StepProjection<D>::scale_of_particle(
    std::int32_t particle, const double* moves) const {
  const auto k = static_cast<std::size_t>(particle);
  double given = 0, change = 0;
  ParticleScale scale;
  for (std::size_t d = 0; d < D; ++d) {
    const double before = h_ * state_.particles.velocities[k * D + d];
    const double now = displacements_[k * D + d];
    given += (moves[d] - before) * (moves[d] - before);
    change += (now - before) * (now - before);
    scale.moved += std::abs(before);
  }
  scale.impulse = std::sqrt(std::max(given, change)) / mobilities_[k];
  return scale;
}

/// Finds the impulse at work on each body: the largest of its own (scale_of_particle), the impulses
/// of its contacts, and the impulses that would stop contacts that still close.
template <int D>
void StepProjection<D>::find_impulses_at_work() {
  body_scales_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    body_scales_.push_back(scale_of_particle(bodies_[b], &free_[b * D]));
  island_impulses_.assign(bodies_.size(), 0.0);
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& now = contacts_[c];
    double w = body_mobilities_[static_cast<std::size_t>(now.second)];
    if (now.first >= 0) w += body_mobilities_[static_cast<std::size_t>(now.first)];
    const double gap = gap_after(geometry_[c], displacements_);
    // In a glued pair the film also pulls, so that an open gap calls for an impulse, too.
    const double impulse =
        std::max(std::abs(now.impulse), (now.gamma < 0 ? std::abs(gap) : -gap) / w);
    for (const auto body : {now.first, now.second})
      if (body >= 0) {
        auto& largest = body_scales_[static_cast<std::size_t>(body)].impulse;
        largest = std::max(largest, impulse);
      }
    auto& of_island = island_impulses_[static_cast<std::size_t>(island(now.second))];
    of_island = std::max(of_island, std::sqrt(w) * impulse);
  }
}

/// Scales of a contact. Of the impulses at work on its two particles the smaller counts, because an
/// impulse that is small for a heavy particle may be all that moves a light one. The rounding
/// errors are those of the gap, of the displacements of its particles, and of a solution for the
/// impulses of all contacts of its island.
template <int D>
typename StepProjection<D>::Scale StepProjection<D>::scale_of(const Contact<D>& here) {
  // Rounding errors are taken as 128 units in the last place of the lengths that are added below.
  constexpr double kRounding = 128 * std::numeric_limits<double>::epsilon();
  Scale scale{0, std::numeric_limits<double>::infinity(), std::abs(here.gap)};
  double around = 0;
  for (const auto particle : {here.first, here.second}) {
    if (particle < 0) continue;
    const auto k = static_cast<std::size_t>(particle);
    const auto number = number_[k];
    const auto own = number < 0 ? scale_of_particle(particle, &displacements_[k * D])
                                : body_scales_[static_cast<std::size_t>(number)];
    scale.w += mobilities_[k];
    scale.impulse = std::min(scale.impulse, own.impulse);
    scale.rounding += mobilities_[k] * own.impulse + own.moved;
    if (number >= 0)
      around = std::max(around, island_impulses_[static_cast<std::size_t>(island(number))]);
  }
  scale.rounding += std::sqrt(scale.w) * around;
  scale.rounding = std::max(kRounding * scale.rounding, std::numeric_limits<double>::min());
  return scale;
}

/// Sets the allowed residual of each chosen contact: at most `length` [L], and at most `fraction`
/// of the impulses at work.
template <int D>
void StepProjection<D>::allow(double length, double fraction) {
  find_impulses_at_work();
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& here = geometry_[c];
    const auto scale = scale_of(here);
    // Half of the allowed residual leaves room for the rounding errors of examine(), which computes
    // the residuals in another way.
    contacts_[c].allowed = scale.allowed(length, fraction) / 2;
  }
}

template <int D>
SolverResult StepProjection<D>::solve_chosen(bool is_rough, int iterations) {
  ContactGraph<D> graph(contacts_, free_, body_mobilities_, pool_);
  graph.largest_island = largest_island_;
  graph.is_rough = is_rough;
  const auto solved = conjugate_gradients(graph, iterations, factor_);
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

/// Measures the residuals of a solution, by the impulses at work in it. The residuals of the chosen
/// contacts are measured only if `is_final`. Returns the pairs that are not chosen yet, have a
/// particle that takes part, and whose gap is now closed. No other pair needs a test, because its
/// particles move freely.
template <int D>
std::vector<std::size_t> StepProjection<D>::examine(const SolverSettings& settings,
                                                    double mean_radius, bool is_final,
                                                    ProjectionResult& result) {
  find_impulses_at_work();
  result.converged = is_final;
  result.residual = result.impulse_residual = result.smallest_gap = 0;
  result.excess = 0;
  result.unresolved = 0;
  result.film_errors.resize(contacts_.size());
  // Records a residual and returns true if it is larger than allowed.
  const auto record_residual = [&](double residual, const Scale& scale) {
    result.residual = std::max(result.residual, residual);
    const double allowed =
        scale.allowed(settings.tolerance * mean_radius / 2, settings.impulse_tolerance);
    const bool beyond = residual > allowed;
    if (beyond) result.converged = false;
    result.excess = std::max(result.excess, residual / allowed);
    if (residual > scale.rounding && scale.impulse > 0)
      result.impulse_residual =
          std::max(result.impulse_residual, residual / scale.w / scale.impulse);
    return beyond;
  };
  const auto note_gap = [&](std::size_t f, double gap) {
    if (gap >= result.smallest_gap) return;
    result.smallest_gap = gap;
    result.narrowest = film(f);
  };
  for (std::size_t c = 0; is_final && c < contacts_.size(); ++c) {
    const auto& now = contacts_[c];
    const auto& here = geometry_[c];
    const auto scale = scale_of(here);
    const double gap = gap_after(here, displacements_);
    const double residual = std::abs(std::min(gap, scale.w * (now.impulse - now.gamma)));
    record_residual(residual, scale);
    result.film_errors[c] = residual / scale.w;
    note_gap(chosen_[c], gap - here.tolerated);
    if ((now.impulse != 0 || now.gamma < 0) &&
        turns_too_far(state_.particles, here, displacements_))
      ++result.unresolved;
  }
  std::vector<std::size_t> closed;
  for (std::size_t f = 0; f < films(); ++f) {
    if (is_chosen_[f] != 0) continue;
    const auto& now = film(f);
    const bool takes_part = number_[static_cast<std::size_t>(now.second)] >= 0 ||
                            (now.first >= 0 && number_[static_cast<std::size_t>(now.first)] >= 0);
    if (!takes_part) continue;
    if (!gap_would_close(f)) continue;
    const auto here = contact(f);
    const double gap = gap_after(here, displacements_);
    if (record_residual(-gap, scale_of(here))) closed.push_back(f);
    note_gap(f, gap - here.tolerated);
  }
  return closed;
}

/// Returns `films` and, from the third round on, also the pairs that they may close in turn. A blow
/// goes through a chain of particles; without this function each round would find only the next
/// one. The depth of the search is 1 in the third round and doubles in each further round.
template <int D>
std::vector<std::size_t> StepProjection<D>::with_pairs_reached_from(
    const std::vector<std::size_t>& films, int round) {
  constexpr int kFirstRound = 3, kLargestDepth = 20;
  if (films.empty() || round < kFirstRound) return films;
  double square = 0;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    double change = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const double moved =
          displacements_[static_cast<std::size_t>(bodies_[b]) * D + d] - free_[b * D + d];
      change += moved * moved;
    }
    square = std::max(square, change);
  }
  const double farthest = std::sqrt(square);
  const auto may_close = [&](std::size_t f) {
    return is_chosen_[f] == 0 && gap_after(contact(f), displacements_) <= farthest;
  };
  if (!pairs_of_particles_) pairs_of_particles_.emplace(state_);
  return pairs_of_particles_->reached(films, 1 << std::min(round - kFirstRound, kLargestDepth),
                                      may_close);
}

template <int D>
ProjectionResult StepProjection<D>::solve(const SolverSettings& settings, double mean_radius) {
  ProjectionResult result;
  // Tolerate half of the allowed overlap. The other half is for the overlap that this step may add.
  tolerated_ = settings.tolerance * mean_radius / 2;
  choose(closed_by_free_motion());
  // Length of the rough solution, in mean radii: box2d with 1000 discs takes as long with 5e-4 to
  // 2e-3, and a tenth longer with 3e-3. The fraction of the impulses at work is 1, because rounding
  // errors, which limit the accuracy of a solution, are known only when the impulses are roughly
  // known.
  constexpr double kRoughLength = 1e-3, kRoughImpulse = 1;
  bool is_rough = settings.tolerance < kRoughLength && settings.impulse_tolerance < kRoughImpulse;
  int rounds = 0;
  int waited = 0;
  double least_excess = std::numeric_limits<double>::infinity();
  while (!chosen_.empty()) {
    allow((is_rough ? kRoughLength : settings.tolerance / 2) * mean_radius,
          is_rough ? kRoughImpulse : settings.impulse_tolerance);
    const auto solved = solve_chosen(is_rough, settings.max_iterations - result.iterations);
    result.iterations += solved.iterations;
    const bool is_last = result.iterations >= settings.max_iterations;
    auto more = examine(settings, mean_radius, !is_rough || is_last, result);
    if (result.converged || is_last) break;
    // A solution that does not improve in several rounds has reached its rounding errors.
    constexpr int kPatience = 10;
    waited = more.empty() && !is_rough && result.excess >= least_excess ? waited + 1 : 0;
    if (waited == kPatience) break;
    if (!is_rough) least_excess = std::min(least_excess, result.excess);
    if (more.empty()) is_rough = false;
    choose(with_pairs_reached_from(more, ++rounds));
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
