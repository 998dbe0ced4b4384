// Rounds of solutions of (5.4), docs/physics.md, and the scales of their residuals.
#include "viscontact/contact_dynamics/projection/step_projection.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace viscontact::particles {
namespace {

struct ProjectionTuning {
  // Gaps below which pairs are chosen before they close, in mean radii, because a further solution
  // with friction takes more time than contacts whose gaps stay open. With Coulomb's law pairs are
  // chosen after a solution has closed further gaps, because redundant contacts would take loads
  // from particles that stand without them; with the convex relaxation, (5.9), before the first
  // solution, but only pairs with a film, because it pushes sliding particles without a film apart.
  // With sweeps these are the only ones, with either law.
  static constexpr double kMargin = 5e-3;
  // The same of optional contacts, which in sweeps are those without a film. With 0.05 to 0.2 steps
  // of 2000 spheres with the convex relaxation take the same time, with 0 a third more.
  static constexpr double kMarginOfOptional = 0.1;
  // Optional contacts follow each other from particle to particle, because impulses go on through
  // pairs that motion without contacts leaves open. While 10 000 spheres fall on each other, a step
  // takes 3.5 solutions with 1 layer of such contacts, 1.5 with 3, and 1 with 6 or 12; the time is
  // 41, 26, 20 and 20 ms.
  static constexpr int kLayersOfOptional = 6;
  // The part of what is allowed to which solutions are computed. The rest is for rounding errors,
  // because examine() computes residuals by other formulas; sweeps leave residuals far above these.
  static constexpr double kPart = 0.5, kPartOfSweeps = 0.95;
};

/// Returns `pairs` in an order in which a Gauss-Seidel sweep is fast. Neighbours in the list share
/// particles, so that the processor would have to finish one contact before it begins the next.
/// Contacts are therefore taken in turn from kInterleaved distant parts of each block of
/// ThreadPool::kBlock pairs: a step of bench/box2d.cpp takes 8.4, 6.8, 6.4, 7.0 and 7.2 ms with 1,
/// 2, 3, 4 and 6 parts.
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
StepProjection<D>::StepProjection(State& state, double h,
                                  std::span<const PlanePosition> planes_before,
                                  std::span<const PlanePosition> planes,
                                  std::span<double> displacements,
                                  std::span<const double> mobilities, ThreadPool& pool,
                                  std::span<const std::int32_t> loaded)
    : state_(state),
      h_(h),
      planes_before_(planes_before),
      planes_(planes),
      displacements_(displacements),
      mobilities_(mobilities),
      pool_(pool),
      loaded_(loaded),
      selection_(pair_count()),
      system_(displacements, mobilities, state.particles) {
  assert(h > 0 && planes_before.size() == planes.size());
  assert(displacements.size() == mobilities.size() * static_cast<std::size_t>(D));
  assert(loaded.empty() || loaded.size() == planes.size());
  find_tangents();
}

template <int D>
void StepProjection<D>::find_tangents() {
  if (std::ranges::none_of(planes_, &PlanePosition::is_curved)) return;
  const auto& p = state_.particles;
  tangents_.clear();
  for (const auto& wall : state_.walls) {
    const auto j = index_of(wall.second);
    tangents_.push_back(tangent_at(
        planes_[wall.plane()], p.position(j) + point_of(displacements_.data(), j, p.dimension)));
  }
}

template <int D>
void StepProjection<D>::add_constraints(const ConstraintStep& step) {
  links_ = step.links;
  step_ = &step;
  constraints_.emplace(step, state_.particles, displacements_, mobilities_);
  system_.follow_turns(step.turns);
  if (D == 2 && state_.particles.has_other_shapes()) shaped_.resize(pair_count());
  constraints_->join_linked(system_);
}

template <int D>
const ShapedContact* StepProjection<D>::shaped(std::size_t k) {
  if (shaped_.empty() || is_round(state_.particles, pair(k))) return nullptr;
  auto& surfaces = shaped_[k];
  if (surfaces == nullptr)
    surfaces = std::make_unique<ShapedContact>(state_.particles, pair(k), planes_);
  return surfaces.get();
}

template <int D>
Contact<D> StepProjection<D>::contact_at_end(std::size_t k) {
  const auto& p = state_.particles;
  auto contact = contact_of<D>(p, pair(k), planes_);
  const auto start = separation<D>(p, pair(k).first, pair(k).second, pair(k).image);
  const auto moved = [&](std::int32_t particle) {
    if (impacts_->is_touched(particle)) return impacts_->displacement(particle);
    const auto body = system_.body_of(particle);
    return body < 0 ? point_of(displacements_.data(), index_of(particle), D)
                    : point_of(system_.free_displacement(index_of(body)), 0, D);
  };
  const Vector relative = moved(pair(k).second) - moved(pair(k).first);
  std::array<double, D> end = start;
  double square = 0, along = 0;
  for (std::size_t d = 0; d < D; ++d) {
    end[d] += relative[d];
    square += end[d] * end[d];
  }
  // The normals of particles that pass each other differ by more than 60 degrees in the step
  // (cosine 0.5). That at the beginning is then used, as in a step without impacts.
  constexpr double kLeastCosine = 0.5;
  double cosine = 0;
  for (std::size_t d = 0; d < D; ++d) cosine += contact.normal[d] * end[d];
  if (!(cosine > kLeastCosine * std::sqrt(square))) return contact;
  for (std::size_t d = 0; d < D; ++d) {
    contact.normal[d] = end[d] / std::sqrt(square);
    along += contact.normal[d] * start[d];
  }
  contact.gap = along - p.radii[index_of(pair(k).first)] - p.radii[index_of(pair(k).second)];
  return contact;
}

template <int D>
bool StepProjection<D>::gap_would_close(std::size_t k, double margin) {
  const auto& p = state_.particles;
  if (!can_bear(k)) return false;
  if (pair(k).first >= 0 && cannot_close<D>(p, pair(k), displacements_, margin)) return false;
  const auto here = contact_at_start(k);
  return (system_.linear_gap(with_gap_to_close(here, k)) < margin || have_passed(here)) &&
         paths_meet(p, here, displacements_);
}

template <int D>
std::vector<std::size_t> StepProjection<D>::closed_by_free_motion() {
  const auto in_block = [&](std::size_t begin, std::size_t end) {
    ConcatenatedBlocks<std::size_t> numbers;
    for (std::size_t k = begin; k < end; ++k)
      if ((Selection::is_bound(pair(k).gamma, pair(k).impulse) && can_bear(k)) ||
          gap_would_close(k, 0))
        numbers.values.push_back(k);
    return numbers;
  };
  return pool_.sum_of_blocks<ConcatenatedBlocks<std::size_t>>(pair_count(), in_block).values;
}

template <int D>
bool StepProjection<D>::has_film(std::size_t k) {
  assert(step_ != nullptr);
  return step_->laws.has_film(radii_of_pair(k));
}

template <int D>
std::vector<std::size_t> StepProjection<D>::nearly_closed(double margin,
                                                          std::optional<bool> have_films) {
  std::vector<std::size_t> pairs;
  for (std::size_t k = 0; k < pair_count(); ++k)
    if (may_have_closed(k) && gap_would_close(k, margin) &&
        (!have_films || has_film(k) == *have_films))
      pairs.push_back(k);
  return pairs;
}

template <int D>
void StepProjection<D>::choose(const std::vector<std::size_t>& pairs, bool are_optional) {
  // With constraints one thread solves each island by itself. The order of the contacts of an
  // island must therefore not depend on other islands.
  for (const auto k : constraints_ ? pairs : interleaved(pairs)) {
    if (constraints_ && constraints_->is_held_apart(pair(k))) {
      selection_.leave_out(k);
      continue;
    }
    selection_.join(k);
    auto added = contact(k);
    added.is_optional = are_optional;
    if (are_optional) added.impulse = 0;
    system_.add(added);
    if (constraints_)
      constraints_->add(system_.contacts.back(), pair(k), state_.memories.of(pair(k).memory));
  }
}

template <int D>
void StepProjection<D>::choose_optional(double mean_radius) {
  for (int layer = 0; layer < ProjectionTuning::kLayersOfOptional; ++layer) {
    const auto near = nearly_closed(ProjectionTuning::kMarginOfOptional * mean_radius, false);
    if (near.empty()) return;
    choose(near, true);
  }
}

template <int D>
void StepProjection<D>::solve_contacts(bool is_rough, double length, int max_iterations,
                                       ProjectionResult& result) {
  if (constraints_) {
    const auto solved = constraints_->solve(system_, is_rough, length / 2, max_iterations);
    result.iterations = solved.iterations;  // of all solutions
    result.stages += solved.stages;
    return;
  }
  const auto solved = system_.solve(is_rough, max_iterations - result.iterations, pool_);
  result.iterations += solved.iterations;
  result.stages += solved.stages;
  if (!is_rough) refine();
}

template <int D>
void StepProjection<D>::allow(double length, double fraction, double of_slips) {
  auto scales = residual_scales();
  const double share = sweeps_ ? ProjectionTuning::kPartOfSweeps : ProjectionTuning::kPart;
  rounding_.clear();
  if (constraints_) {
    constraints_->slips_allowed.clear();
    constraints_->allowed_errors.clear();
  }
  for (auto& contact : system_.contacts) {
    const auto scale = scales.of(contact);
    contact.allowed = share * scale.allowed(length, fraction);
    rounding_.push_back(scale.rounding);
    if (constraints_) constraints_->allowed_errors.push_back(fraction * scale.impulse);
    if (constraints_)
      constraints_->slips_allowed.push_back(share * scale.allowed(length, of_slips));
  }
  if (!constraints_) return;
  constraints_->links_allowed.clear();
  constraints_->rounding = rounding_;
  for (const auto& link : constraints_->links()) {
    const auto scale = scale_of_link(link, scales);
    constraints_->links_allowed.push_back(scale.allowed(length / 2, fraction) / 2);
    constraints_->allowed_errors.push_back(fraction * scale.impulse);
    constraints_->rounding.push_back(scale.rounding);
  }
}

template <int D>
std::vector<std::size_t> StepProjection<D>::with_connected_pairs(
    const std::vector<std::size_t>& pairs, int round) {
  // Otherwise each round would find only the next pair of a chain through which an impulse goes.
  // The chain is followed over 1 pair in round 3, and over twice as many in each further round. A
  // gap may close if it is not larger than the largest change of a displacement by contacts and
  // links in the island of a particle. 2 to the power of kLargestDepth must be an int.
  constexpr int kFirstRound = 3, kLargestDepth = 20;
  if (pairs.empty() || round < kFirstRound) return pairs;
  std::vector<double> farthest(system_.bodies().size());  // in each island, at its root
  for (std::size_t b = 0; b < farthest.size(); ++b) {
    double square = 0;
    for (std::size_t d = 0; d < D; ++d) {
      const double moved =
          displacements_[index_of(system_.bodies()[b]) * D + d] - system_.free_displacement(b)[d];
      square += moved * moved;
    }
    auto& of_island = farthest[index_of(system_.island(static_cast<std::int32_t>(b)))];
    of_island = std::max(of_island, std::sqrt(square));
  }
  const auto farthest_of = [&](std::int32_t particle) {
    return takes_part(particle) ? farthest[index_of(system_.island(system_.body_of(particle)))] : 0;
  };
  const auto may_close = [&](std::size_t k) {
    return !selection_.is_decided(k) && can_bear(k) &&
           system_.gap(contact(k)) <=
               std::max(farthest_of(pair(k).first), farthest_of(pair(k).second));
  };
  if (!pairs_of_particles_) pairs_of_particles_.emplace(state_);
  const int depth = 1 << std::min(round - kFirstRound, kLargestDepth);
  return pairs_of_particles_->connected(pairs, depth, may_close);
}

template <int D>
std::vector<std::size_t> StepProjection<D>::leave_touching(std::vector<std::size_t>& pairs,
                                                           const SolverSettings& settings,
                                                           double mean_radius) {
  // The convex relaxation of friction, docs/physics.md (5.9), pushes apart each chosen pair that
  // slides. For a particle that slides along an obstacle without load, rounding errors would decide
  // whether the pair is chosen.
  auto scales = residual_scales();
  std::vector<std::size_t> had_impulses;
  std::erase_if(pairs, [&](std::size_t k) {
    if (Selection::is_bound(pair(k).gamma, 0) || has_film(k)) return false;
    const auto here = contact(k);
    const double allowed = scales.of(here).allowed_gap(settings, mean_radius);
    const bool has_impulse = pair(k).impulse != 0;
    const bool is_loaded = has_impulse && !(sweeps_ && here.w * pair(k).impulse <= allowed);
    if (is_loaded || -system_.linear_gap(here) > allowed) return false;
    if (has_impulse) had_impulses.push_back(k);
    return true;
  });
  return had_impulses;
}

template <int D>
ProjectionResult StepProjection<D>::solve(const SolverSettings& settings, double mean_radius,
                                          bool can_be_divided) {
  assert(selection_.members().empty() && mean_radius > 0);
  ProjectionResult result;
  // An overlap up to half of the tolerance is left as it is. The other half of the tolerance is for
  // the error that this step adds.
  tolerated_ = settings.tolerance * mean_radius / 2;
  counts_mean_load_ = settings.accuracy == Accuracy::kPacking;
  sweeps_ = constraints_ && settings.suits_sweeps();
  if (sweeps_) constraints_->start = ConstraintStart::kAcceleratedSweeps;
  const bool has_friction = step_ != nullptr && step_->laws.friction;
  const bool is_convex = has_friction && step_->laws.friction->method == FrictionMethod::kConvex;
  if (constraints_)
    constraints_->can_be_divided = can_be_divided && sweeps_ && has_friction && !is_convex;
  // The motion with links and without contacts decides which contacts are chosen. Without its hinge
  // or arm, a particle would meet walls from which the hinge or arm keeps it away.
  if (constraints_ && !constraints_->links().empty()) {
    allow(settings.tolerance / 2 * mean_radius, settings.impulse_tolerance,
          fraction_of_slips(settings));
    solve_contacts(false, 0, settings.max_iterations, result);
    find_tangents();
  }
  auto closed = closed_by_free_motion();
  std::vector<std::size_t> had_impulses;
  if (is_convex) had_impulses = leave_touching(closed, settings, mean_radius);
  choose(closed);
  choose(had_impulses, true);
  if (has_friction) {
    margin_ = ProjectionTuning::kMargin * mean_radius;
    if (is_convex || sweeps_) choose(nearly_closed(margin_, true));
    if (sweeps_) choose_optional(mean_radius);
  }
  // Tolerances of the rough solution: of gaps in mean radii, and of impulses as a fraction of the
  // impulse at work, 1, because impulses are not known yet. For bench/box2d.cpp with 1000 discs,
  // steps with 5e-4 to 2e-3 take the same time, and with 3e-3 a tenth more.
  constexpr double kRoughLength = 1e-3, kRoughImpulse = 1;
  bool is_rough =
      !sweeps_ && settings.tolerance < kRoughLength && settings.impulse_tolerance < kRoughImpulse;
  int rounds = 0;
  int waited = 0;
  int rounds_unsolved = 0;
  double least_excess = std::numeric_limits<double>::infinity();
  while (!system_.bodies().empty()) {
    const double length = (is_rough ? kRoughLength : settings.tolerance / 2) * mean_radius;
    allow(length, is_rough ? kRoughImpulse : settings.impulse_tolerance,
          fraction_of_slips(settings));
    // A rough solution with friction or links leaves half of the iterations to the accurate one.
    const int most =
        is_rough && constraints_ ? settings.max_iterations / 2 : settings.max_iterations;
    solve_contacts(is_rough, length, most, result);
    const bool is_last = result.iterations >= settings.max_iterations;
    auto more = examine(settings, mean_radius, !is_rough || is_last, result);
    if (constraints_ && constraints_->needs_shorter_step()) {
      result.needs_shorter_step = true;
      result.residuals.converged = false;
    }
    if (result.residuals.converged || result.needs_shorter_step) break;
    if (is_last || (constraints_ && constraints_->has_given_up() && !is_convex)) {
      // An island is not solved, or given loads bound its friction in place of Coulomb's law. Pairs
      // that solutions close are still added, also to other islands, in at most kMostRounds rounds,
      // which bounds the time of such a step.
      constexpr int kMostRounds = 20;
      if (!constraints_ || ++rounds_unsolved > kMostRounds) break;
      // The gaps of a rough solution are not accurate, so that another solution must follow it.
      if (more.empty() && !is_rough) break;
      is_rough = false;
    }
    // After kPatience rounds in which no pair is added and the residuals do not fall, only rounding
    // errors are left.
    constexpr int kPatience = 10;
    waited = more.empty() && !is_rough && result.residuals.excess >= least_excess ? waited + 1 : 0;
    if (waited == kPatience) break;
    if (!is_rough) least_excess = std::min(least_excess, result.residuals.excess);
    choose(with_connected_pairs(more, ++rounds));
    // If a rough solution nearly closes further pairs, another one may follow. Whether it does must
    // not depend on other islands. With Coulomb's law, whose loads rough solutions build up, it
    // always follows; with the convex relaxation never.
    if (is_convex && more.empty()) is_rough = false;
    const bool takes_near = margin_ > 0 && !(is_convex && is_rough);
    const bool only_films = is_convex || sweeps_;
    const auto near = takes_near
                          ? nearly_closed(margin_, only_films ? std::optional(true) : std::nullopt)
                          : std::vector<std::size_t>{};
    choose(near);
    if (sweeps_ && has_friction && !more.empty()) choose_optional(mean_radius);
    if (more.empty() && near.empty()) is_rough = false;
  }
  result.turns_too_far |= !result.residuals.converged && shapes_turn();
  auto scales = residual_scales();
  std::vector<double> impulse_errors;
  for (std::size_t c = 0; c < selection_.members().size(); ++c) {
    auto& of_contact = pair(selection_.members()[c]);
    // Friction that given loads bound needs no normal impulse.
    if (system_.contacts[c].is_optional && system_.contacts[c].impulse == 0 &&
        of_contact.impulse == 0 && norm(constraints_->friction(c)) == 0)
      continue;
    impulse_errors.push_back(result.residuals.impulse_errors[c]);
    result.pairs.push_back(&of_contact);
    if (!shaped_.empty()) result.radii.push_back(radii_of_pair(selection_.members()[c]));
    // A pair with an impulse is chosen in the next step, too, where the convex relaxation may push
    // its particles apart. An impulse that is no larger than its allowed error must not do so.
    const auto& here = system_.contacts[c];
    const double error = scales.of(here).allowed_gap(settings, mean_radius) / here.w;
    const bool is_error = is_convex && !sweeps_ && here.lowest == 0 && here.impulse <= error;
    result.impulses.push_back(is_error ? 0 : here.impulse);
    if (!constraints_) {
      take_given(c, {}, result);
      continue;
    }
    auto memory = state_.memories.of(pair(selection_.members()[c]).memory);
    constraints_->remember(c, memory);
    if (is_error) {
      memory[Remembered::kSolidLoad] = 0;
      // If given loads bound the friction, it may be large although the normal impulse is 0.
      if (norm(memory.friction()) <= error) memory.set_friction({});
    }
    result.memories.push_back(memory);
    take_given(c, memory, result);
  }
  result.residuals.impulse_errors = std::move(impulse_errors);
  result.bodies = system_.bodies();
  if (constraints_) constraints_->add_loads_across(result.on_given);
  result.buckling = constraints_ ? constraints_->buckling() : 0;
  result.has_given_loads = constraints_ && constraints_->has_given_up();
  return result;
}

template <int D>
bool StepProjection<D>::shapes_turn() const {
  if constexpr (D == 2) {
    // Corrections for turns that are smaller [rad] do not decide whether a step is solved.
    constexpr double kSmallTurn = 1e-3;
    return std::ranges::any_of(system_.contacts, [&](const Contact<D>& contact) {
      return contact.shaped != nullptr &&
             turn_of_shapes(contact, displacements_, step_->turns) > kSmallTurn;
    });
  }
  return false;
}

template <int D>
void StepProjection<D>::take_given(std::size_t c, const PairMemory& memory,
                                   ProjectionResult& result) {
  assert(c < selection_.members().size());
  const auto& here = system_.contacts[c];
  const auto is_given = [&](std::int32_t k) { return k >= 0 && !(mobilities_[index_of(k)] > 0); };
  Vector normal{};
  std::ranges::copy(here.normal, normal.begin());
  const Vector along = result.impulses.back() * normal + memory.friction();
  const Vector on_second = along + memory.across();
  // The arms end at one point, in the ratio of the radii, as those of tangents_of().
  const auto [centres, radii] = circles_of(here, state_.particles);
  const double share = here.first < 0 ? 1 : 1 + (here.gap - here.tolerated) / (radii[1] + radii[0]);
  if (is_given(here.second))
    result.on_given.push_back(
        {here.second, on_second, cross(centres[1] - radii[1] * share * normal, along)});
  if (is_given(here.first))
    result.on_given.push_back({here.first, -1.0 * on_second,
                               cross(centres[0] + radii[0] * share * normal, -1.0 * along)});
}

template class StepProjection<2>;
template class StepProjection<3>;

template <int D>
ResidualScales<D>::ResidualScales(const State& state, double h,
                                  std::span<const double> displacements,
                                  std::span<const double> mobilities, ContactSystem<D>& system,
                                  const ConstraintSystem<D>* constraints, bool counts_mean_load)
    : state_(state),
      h_(h),
      displacements_(displacements),
      mobilities_(mobilities),
      system_(system),
      has_constraints_(constraints != nullptr),
      island_impulses_(system.bodies().size(), 0.0) {
  const auto& bodies = system.bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b)
    body_scales_.push_back(of_particle(bodies[b], system.free_displacement(b)));
  // At work is also what contacts bear, and what would end their overlaps.
  for (const auto& contact : system.contacts) {
    const double gap = system.gap(contact);
    // The film of a pair with gamma < 0 also pulls. Therefore an impulse would be needed to close
    // an open gap, too.
    const double impulse = std::max(std::abs(contact.impulse),
                                    (contact.lowest < 0 ? std::abs(gap) : -gap) / contact.w);
    for (const auto particle : {contact.first, contact.second})
      if (particle >= 0) {
        auto& largest = body_scales_[index_of(system.body_of(particle))].impulse;
        largest = std::max(largest, impulse);
      }
    auto& of_island = island_impulses_[index_of(system.island(system.body_of(contact.second)))];
    of_island = std::max(of_island, std::sqrt(contact.w) * impulse);
  }
  if (counts_mean_load) take_mean_loads();
  if (constraints == nullptr) return;
  for (std::size_t l = 0; l < constraints->links().size(); ++l) {
    const auto& link = constraints->links()[l];
    for (std::size_t k = 0; k < link.rows.size(); ++k)
      for (const auto& part : link.rows[k].parts) {
        double impulse = std::abs(constraints->link_impulse(l, k)) * norm(part.direction);
        if (link.is_angle()) impulse /= state.particles.radii[index_of(part.particle)];
        auto& largest = body_scales_[index_of(system.body_of(part.particle))].impulse;
        largest = std::max(largest, impulse);
      }
  }
}

template <int D>
void ResidualScales<D>::take_mean_loads() {
  mean_loads_.assign(system_.bodies().size(), 0.0);
  std::vector<double> counts(mean_loads_.size());
  for (const auto& contact : system_.contacts) {
    if (!(contact.impulse > 0)) continue;
    const auto root = index_of(system_.island(system_.body_of(contact.second)));
    mean_loads_[root] += contact.impulse;
    ++counts[root];
  }
  for (std::size_t b = 0; b < counts.size(); ++b) mean_loads_[b] /= std::max(1.0, counts[b]);
}

template <int D>
typename ResidualScales<D>::ParticleScale ResidualScales<D>::of_particle(
    std::int32_t particle, const double* moves) const {
  const auto k = index_of(particle);
  double given = 0, change = 0;
  ParticleScale scale;
  if (k >= state_.particles.count()) return scale;  // a plane under a load
  for (std::size_t d = 0; d < D; ++d) {
    const double before = h_ * state_.particles.velocities[k * D + d];
    const double now = displacements_[k * D + d];
    given += (moves[d] - before) * (moves[d] - before);
    change += (now - before) * (now - before);
    scale.moved += std::abs(before);
  }
  if (mobilities_[k] > 0) scale.impulse = std::sqrt(std::max(given, change)) / mobilities_[k];
  return scale;
}

template <int D>
typename ResidualScales<D>::ParticleScale ResidualScales<D>::of_particle(
    std::int32_t particle) const {
  const auto body = system_.body_of(particle);
  return body < 0 ? of_particle(particle, &displacements_[index_of(particle) * D])
                  : body_scales_[index_of(body)];
}

template <int D>
double ResidualScales<D>::largest_change(std::span<const std::int32_t> particles) const {
  double largest = 0;
  for (const auto particle : particles)
    largest = std::max(largest, mobilities_[index_of(particle)] * of_particle(particle).impulse);
  return largest;
}

template <int D>
ResidualScale ResidualScales<D>::of(std::span<const std::int32_t> particles, double w,
                                    double length) {
  // Rounding errors are taken as 128 units in the last place of the sum of the lengths below.
  constexpr double kRounding = 128 * std::numeric_limits<double>::epsilon();
  ResidualScale scale{w, std::numeric_limits<double>::infinity(), length};
  double around = 0, mean_load = 0;
  for (const auto particle : particles) {
    if (particle < 0) continue;
    const auto k = index_of(particle);
    const auto body = system_.body_of(particle);
    const auto own = of_particle(particle);
    if (mobilities_[k] > 0) scale.impulse = std::min(scale.impulse, own.impulse);
    scale.rounding += mobilities_[k] * own.impulse + own.moved;
    if (body < 0) continue;
    const auto root = index_of(system_.island(body));
    around = std::max(around, island_impulses_[root]);
    if (!mean_loads_.empty()) mean_load = std::max(mean_load, mean_loads_[root]);
  }
  scale.impulse = std::max(scale.impulse, mean_load);
  scale.rounding += std::sqrt(scale.w) * around;
  // Solvers compute squares of displacements and products of these, which underflow below this
  // length [L]. A particle that moves by less is at rest in any unit of length.
  constexpr double kAtRest = 1e-100;
  scale.rounding = std::max(kRounding * scale.rounding, kAtRest);
  return scale;
}

template <int D>
ResidualScale ResidualScales<D>::of(const Contact<D>& contact) {
  const std::array particles{contact.first, contact.second};
  double length = std::abs(contact.gap);
  if (contact.loaded_plane >= 0)
    length += norm(point_of(displacements_.data(), index_of(contact.loaded_plane), D));
  auto scale = of(particles, contact.w, length);
  if (!has_constraints_) return scale;
  // 1 unit in the last place of the radii, or, where bodies or links turn, 8 units in that of the
  // radii and of the distances from the origin, because lengths of links are differences of
  // coordinates.
  const bool has_finite_turns = system_.has_finite_turns(contact);
  const double rounding = (has_finite_turns ? 8 : 1) * std::numeric_limits<double>::epsilon();
  double lengths = 0;
  for (const auto particle : particles)
    if (particle >= 0)
      lengths += state_.particles.radii[index_of(particle)] +
                 (has_finite_turns ? norm(state_.particles.position(index_of(particle))) : 0);
  scale.rounding = std::max(scale.rounding, rounding * lengths);
  return scale;
}

template class ResidualScales<2>;
template class ResidualScales<3>;

}  // namespace viscontact::particles
