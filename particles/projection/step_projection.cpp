// Chooses the contacts of a step, solves the projection in rounds, and measures residuals
// (step_projection.hpp). Lengths, masses and times are in the units of the case.
#include "viscontact/particles/projection/step_projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

/// Puts pairs in an order in which a sweep is fast. Neighbours in the list share particles, so that
/// in a sweep each contact would wait for the result of the contact before it. This order takes
/// contacts from three distant parts of the list in turn, within each block of the thread pool. A
/// step of bench/box2d.cpp takes 8.4, 6.8, 6.4, 7.0 and 7.2 ms with 1, 2, 3, 4 and 6 parts.
std::vector<std::size_t> interleaved(const std::vector<std::size_t>& pairs) {
  constexpr std::size_t kInterleaved = 3;
  std::vector<std::size_t> order;
  order.reserve(pairs.size());
  for (std::size_t begin = 0; begin < pairs.size(); begin += ThreadPool::kBlock) {
    const std::size_t end = std::min(begin + ThreadPool::kBlock, pairs.size());
    const std::size_t strand = (end - begin + kInterleaved - 1) / kInterleaved;
    for (std::size_t first = begin; first < begin + strand; ++first)
      for (std::size_t k = first; k < end; k += strand) order.push_back(pairs[k]);
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
      is_chosen_(pair_count(), 0),
      system_(displacements, mobilities, state.particles.bodies) {
  if (std::ranges::none_of(planes, &PlanePosition::is_curved)) return;
  const auto& p = state.particles;
  for (const auto& wall : state.walls) {
    const auto j = index_of(wall.second);
    tangents_.push_back(tangent_at(planes[wall.plane()],
                                   p.position(j) + point_of(displacements.data(), j, p.dimension)));
  }
}

template <int D>
void StepProjection<D>::add_constraints(const ConstraintStep& step) {
  links_ = step.links;
  constraints_.emplace(step, state_.particles, displacements_, mobilities_);
  constraints_->join_linked(system_);
}

/// True if the displacements close the gap of pair k.
template <int D>
bool StepProjection<D>::gap_would_close(std::size_t k) {
  const auto& p = state_.particles;
  if (pair(k).first >= 0 && cannot_close<D>(p, pair(k), displacements_)) return false;
  const auto here = contact_at_start(k);
  return gap_after(resolved(here, p, pair(k), planes_, tolerated_), displacements_) < 0 &&
         paths_meet(p, here, displacements_);
}

template <int D>
std::vector<std::size_t> StepProjection<D>::closed_by_free_motion() {
  const auto in_block = [&](std::size_t begin, std::size_t end) {
    ConcatenatedBlocks<std::size_t> numbers;
    for (std::size_t k = begin; k < end; ++k)
      if (pair(k).gamma < 0 || pair(k).impulse != 0 || gap_would_close(k))
        numbers.values.push_back(k);
    return numbers;
  };
  return pool_.sum_of_blocks<ConcatenatedBlocks<std::size_t>>(pair_count(), in_block).values;
}

template <int D>
void StepProjection<D>::choose(const std::vector<std::size_t>& pairs) {
  for (const auto k : interleaved(pairs)) {
    is_chosen_[k] = 1;
    chosen_.push_back(k);
    system_.add(contact(k));
    if (constraints_) constraints_->add(system_.contacts.back(), pair(k).friction);
  }
}

/// Solves for the impulses of the chosen contacts and of the links. With friction, tangential
/// displacements are accurate to half of `length` [L].
template <int D>
SolverResult StepProjection<D>::solve_contacts(bool is_rough, double length, int max_iterations) {
  if (constraints_) return constraints_->solve(system_, is_rough, length / 2, max_iterations);
  return system_.solve(is_rough, max_iterations, pool_);
}

/// Sets the allowed residual of each chosen contact: at most `length` [L], and at most `fraction`
/// of the impulses at work.
template <int D>
void StepProjection<D>::allow(double length, double fraction) {
  auto scales = residual_scales();
  // Half of the allowed residual leaves room for the rounding errors of examine(), which computes
  // the residuals in another way.
  for (auto& contact : system_.contacts)
    contact.allowed = scales.of(contact).allowed(length, fraction) / 2;
  if (!constraints_) return;
  constraints_->links_allowed.clear();
  for (const auto& link : constraints_->links())
    constraints_->links_allowed.push_back(
        scale_of_link(link, scales).allowed(length / 2, fraction) / 2);
}

/// The scales of a link are those of a contact between its particles, at which a force is at work
/// also if all is at rest: its own.
template <int D>
ResidualScale StepProjection<D>::scale_of_link(const LinkEquations& link,
                                               ResidualScales<D>& scales) const {
  const auto& row = link.rows.front();
  Contact<D> contact{};
  contact.first = row.first.particle;
  contact.second = row.second.particle;
  for (const auto particle : {contact.first, contact.second})
    if (particle >= 0) contact.gap += norm(state_.particles.position(index_of(particle)));
  return scales.of(contact);
}

/// Measures the residuals of the links as those of contacts are measured.
template <int D>
void StepProjection<D>::examine_links(const SolverSettings& settings, double mean_radius,
                                      ProjectionResult& result) {
  auto scales = residual_scales();
  const auto& links = constraints_->links();
  std::vector<std::size_t> beyond;
  for (std::size_t l = 0; l < links.size(); ++l) {
    const double residual = constraints_->link_residual(l);
    const auto scale = scale_of_link(links[l], scales);
    const double allowed =
        scale.allowed(settings.tolerance * mean_radius / 2, settings.impulse_tolerance);
    result.residual = std::max(result.residual, residual);
    result.link_residual = std::max(result.link_residual, residual);
    result.excess = std::max(result.excess, residual / allowed);
    if (residual > scale.rounding && scale.impulse > 0)
      result.impulse_residual =
          std::max(result.impulse_residual, residual / scale.w / scale.impulse);
    if (!(residual <= allowed)) beyond.push_back(l);
  }
  if (beyond.empty()) return;
  result.converged = false;
  // Named are also the links that hold the same particles, because one of them may be the cause.
  std::vector<char> is_held(state_.particles.count(), 0);
  const auto for_particles = [&](const LinkEquations& link, const auto& visit) {
    for (const auto* part : {&link.rows.front().first, &link.rows.front().second}) {
      if (part->particle < 0) continue;
      const auto body = state_.particles.bodies.body_of(part->particle);
      if (body < 0) visit(index_of(part->particle));
      if (body >= 0)
        for (const auto member : state_.particles.bodies.bodies[index_of(body)].members)
          visit(index_of(member));
    }
  };
  for (const auto l : beyond) for_particles(links[l], [&](std::size_t k) { is_held[k] = 1; });
  for (const auto& link : links) {
    bool is_named = false;
    for_particles(link, [&](std::size_t k) { is_named = is_named || is_held[k] != 0; });
    if (is_named && link.kind != LinkEquations::Kind::kTorsion &&
        link.kind != LinkEquations::Kind::kSpring)
      result.unsolved_links.push_back(name_of(link, *links_, state_.particles));
  }
}

/// Measures the residuals of a solution, by the impulses at work in it. The residuals of the chosen
/// contacts are measured only if `is_final`. Returns the pairs that are not chosen yet, have a
/// particle that takes part, and whose gap is now closed. No other pair needs a test, because its
/// particles move freely.
template <int D>
std::vector<std::size_t> StepProjection<D>::examine(const SolverSettings& settings,
                                                    double mean_radius, bool is_final,
                                                    ProjectionResult& result) {
  auto scales = residual_scales();
  result.converged = is_final;
  result.residual = result.impulse_residual = result.smallest_gap = result.excess = 0;
  result.unresolved = 0;
  result.link_residual = 0;
  result.unsolved_links.clear();
  result.impulse_errors.resize(system_.contacts.size());
  // Records a residual and returns true if it is larger than allowed.
  const auto record_residual = [&](double residual, const ResidualScale& scale) {
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
  // A sticking contact may slip by the tolerance of the gaps: its impulse is not unique in packings,
  // and no memory depends on it.
  const auto record_slip = [&](double residual) {
    const double allowed = settings.tolerance * mean_radius / 2;
    result.residual = std::max(result.residual, residual);
    result.excess = std::max(result.excess, residual / allowed);
    if (residual > allowed) result.converged = false;
  };
  const auto record_gap = [&](std::size_t k, double gap) {
    if (gap >= result.smallest_gap) return;
    result.smallest_gap = gap;
    result.deepest_overlap = pair(k);
  };
  for (std::size_t c = 0; is_final && c < chosen_.size(); ++c) {
    const auto& here = system_.contacts[c];
    const auto scale = scales.of(here);
    const double gap = gap_after(here, displacements_);
    const double residual = constraints_
                                ? constraints_->residual(c).normal
                                : std::abs(std::min(gap, scale.w * (here.impulse - here.gamma)));
    record_residual(residual, scale);
    if (constraints_) record_slip(constraints_->residual(c).tangential);
    result.impulse_errors[c] = residual / scale.w;
    record_gap(chosen_[c], gap - here.tolerated);
    if ((here.impulse != 0 || here.gamma < 0) &&
        turns_too_far(state_.particles, here, displacements_))
      ++result.unresolved;
  }
  if (constraints_ && is_final) examine_links(settings, mean_radius, result);
  std::vector<std::size_t> closed;
  for (std::size_t k = 0; k < pair_count(); ++k) {
    if (is_chosen_[k] != 0 || !(takes_part(pair(k).second) || takes_part(pair(k).first)) ||
        !gap_would_close(k))
      continue;
    const auto here = contact(k);
    const double gap = gap_after(here, displacements_);
    if (record_residual(-gap, scales.of(here))) closed.push_back(k);
    record_gap(k, gap - here.tolerated);
  }
  return closed;
}

/// Returns `pairs` and, from the third round on, also the pairs whose gaps they may close in turn.
/// A blow goes through a chain of particles; without this function each round would find only the
/// next pair of the chain. The depth of the search is 1 in the third round and doubles in each
/// further round.
template <int D>
std::vector<std::size_t> StepProjection<D>::with_connected_pairs(
    const std::vector<std::size_t>& pairs, int round) {
  constexpr int kFirstRound = 3, kLargestDepth = 20;
  if (pairs.empty() || round < kFirstRound) return pairs;
  double square = 0;
  for (std::size_t b = 0; b < system_.bodies().size(); ++b) {
    double change = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const double moved =
          displacements_[index_of(system_.bodies()[b]) * D + d] - system_.free_displacement(b)[d];
      change += moved * moved;
    }
    square = std::max(square, change);
  }
  const double farthest = std::sqrt(square);
  const auto may_close = [&](std::size_t k) {
    return is_chosen_[k] == 0 && gap_after(contact(k), displacements_) <= farthest;
  };
  if (!pairs_of_particles_) pairs_of_particles_.emplace(state_);
  const int depth = 1 << std::min(round - kFirstRound, kLargestDepth);
  return pairs_of_particles_->connected(pairs, depth, may_close);
}

template <int D>
ProjectionResult StepProjection<D>::solve(const SolverSettings& settings, double mean_radius) {
  ProjectionResult result;
  // Tolerate half of the allowed overlap. The other half is for the overlap that this step may add.
  tolerated_ = settings.tolerance * mean_radius / 2;
  choose(closed_by_free_motion());
  // Tolerances of the rough solution: of the gaps in mean radii, and of the impulses as a fraction
  // of the impulses at work. For bench/box2d.cpp with 1000 discs, gaps of 5e-4 to 2e-3 take equally
  // long, 3e-3 a tenth longer. The fraction is 1, because the rounding errors that limit it are
  // known only when the impulses are roughly known.
  constexpr double kRoughLength = 1e-3, kRoughImpulse = 1;
  bool is_rough = settings.tolerance < kRoughLength && settings.impulse_tolerance < kRoughImpulse;
  int rounds = 0;
  int waited = 0;
  double least_excess = std::numeric_limits<double>::infinity();
  while (!system_.bodies().empty()) {
    const double length = (is_rough ? kRoughLength : settings.tolerance / 2) * mean_radius;
    allow(length, is_rough ? kRoughImpulse : settings.impulse_tolerance);
    result.iterations +=
        solve_contacts(is_rough, length, settings.max_iterations - result.iterations).iterations;
    const bool is_last = result.iterations >= settings.max_iterations;
    auto more = examine(settings, mean_radius, !is_rough || is_last, result);
    if (result.converged || is_last) break;
    // A solution that does not improve in several rounds has reached its rounding errors.
    constexpr int kPatience = 10;
    waited = more.empty() && !is_rough && result.excess >= least_excess ? waited + 1 : 0;
    if (waited == kPatience) break;
    if (!is_rough) least_excess = std::min(least_excess, result.excess);
    if (more.empty()) is_rough = false;
    choose(with_connected_pairs(more, ++rounds));
  }
  for (std::size_t c = 0; c < chosen_.size(); ++c) {
    pair(chosen_[c]).impulse = system_.contacts[c].impulse;
    if (constraints_) {
      pair(chosen_[c]).friction = constraints_->friction(c);
      pair(chosen_[c]).carried = constraints_->carried(c);
    }
    result.pairs.push_back(&pair(chosen_[c]));
  }
  result.bodies = system_.bodies();
  return result;
}

template class StepProjection<2>;
template class StepProjection<3>;

}  // namespace viscontact::particles
