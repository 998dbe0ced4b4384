// Steps of (5.6) to (5.9), (5.17) and (5.21), docs/physics.md, island by island.
#include "viscontact/contact_dynamics/constraints/constraint_system.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "viscontact/contact_dynamics/constraints/island_ladder.hpp"

namespace viscontact::particles {
namespace {

struct HeldApartTuning {
  // A case may give lengths that are shorter by the rounding errors of its numbers.
  static constexpr double kShorter = 1e-6;
  // Rounding errors of a distance over the distance.
  static constexpr double kRounding = 1e-9;
};

}  // namespace

template <int D>
ConstraintSystem<D>::ConstraintSystem(const ConstraintStep& step, const Particles& particles,
                                      std::span<double> displacements,
                                      std::span<const double> mobilities)
    : step_(step),
      particles_(particles),
      displacements_(displacements),
      mobilities_(mobilities),
      mean_radius_(mean_radius(particles)),
      is_convex_(step.laws.friction && step.laws.friction->method == FrictionMethod::kConvex),
      times_{step.end - step.begin, step.impulse_time, step.end, step.is_first},
      free_turns_(step.turns.begin(), step.turns.end()),
      free_bodies_(step.bodies.begin(), step.bodies.end()),
      links_(link_equations(*step.links, particles, times_)),
      link_residuals_(links_.size(), 0.0),
      link_forces_(step.link_forces.begin(), step.link_forces.end()),
      first_link_forces_(link_forces_),
      unit_of_particle_(mobilities.size(), -1),
      unit_of_body_(particles.bodies.count(), -1),
      offsets_(particles.bodies.empty() ? 0 : particles.count()) {
  assert(step.end > step.begin && step.impulse_time > 0);
  assert(displacements.size() == mobilities.size() * static_cast<std::size_t>(D));
  assert(step.turn_mobilities.size() == mobilities.size());
  assert(step.turns.size() == mobilities.size() * static_cast<std::size_t>(kTurns<D>));
  for (auto& stop : stop_equations(*step.links, particles)) {
    links_.push_back(std::move(stop));
    link_residuals_.push_back(0);
  }
  link_errors_.resize(links_.size());
  for (const auto& body : particles.bodies.bodies)
    for (std::size_t m = 0; m < body.members.size(); ++m)
      offsets_[index_of(body.members[m])] = present_offset(body, m, D);
}

template <int D>
void ConstraintSystem<D>::join_linked(ContactSystem<D>& system) const {
  for (const auto& link : links_)
    for (const auto& part : link.parts()) {
      system.connect(link.parts().front().particle, part.particle);
      if (!link.is_spring()) system.mark_finite_turns(part.particle);
    }
}

template <int D>
bool ConstraintSystem<D>::is_held_apart(const Pair& pair) const {
  for (const auto& arm : step_.links->arms) {
    if (std::minmax(arm.first, arm.second) != std::minmax(pair.first, pair.second)) continue;
    const auto i = index_of(pair.first), j = index_of(pair.second);
    const double touching =
        (1 - HeldApartTuning::kShorter) * (particles_.radii[i] + particles_.radii[j]);
    // An arm holds the nearest image. Other images may touch, also if they are equally near.
    const Vector nearest =
        nearest_image(particles_.cell, particles_.position(j) - particles_.position(i));
    Vector apart{};
    std::ranges::copy(separation<D>(particles_, pair.first, pair.second, pair.image),
                      apart.begin());
    return length_at(arm.length, times_.end) >= touching &&
           norm(apart - nearest) <= HeldApartTuning::kRounding * norm(nearest);
  }
  return false;
}

template <int D>
void ConstraintSystem<D>::add(const Contact<D>& contact, const Pair& pair,
                              const PairMemory& memory) {
  ContactState state;
  state.tangents = tangents_of(contact, particles_, step_.obstacles, step_.begin, step_.end);
  state.tangents.capacity =
      pair.gamma - step_.laws.lowest_gamma(pair, memory,
                                           contact.shaped != nullptr
                                               ? contact.shaped->radii()
                                               : radii_of(pair, particles_, step_.obstacles));
  state.friction = memory.friction();
  state.solid_load = state.first_load = memory[Remembered::kSolidLoad];
  contact_states_.push_back(state);
}

template <int D>
void ConstraintSystem<D>::find_islands(ContactSystem<D>& system) {
  islands_.clear();
  std::vector<std::int32_t> number(system.bodies().size(), -1);  // of the islands, at their roots
  const auto island_of = [&](std::int32_t particle) -> Island& {
    auto& n = number[index_of(system.island(system.body_of(particle)))];
    if (n < 0) {
      n = static_cast<std::int32_t>(islands_.size());
      islands_.emplace_back();
    }
    return islands_[index_of(n)];
  };
  for (const auto particle : system.bodies())
    island_of(particle).bodies.push_back(system.body_of(particle));
  for (std::size_t c = 0; c < system.contacts.size(); ++c) {
    auto& island = island_of(system.contacts[c].second);
    island.contacts.push_back(c);
    island.has_given_up |= contact_states_[c].gave_up;
    island.can_give_up &= !contact_states_[c].could_not_give_up;
  }
  for (std::size_t l = 0; l < links_.size(); ++l)
    island_of(links_[l].parts().front().particle).links.push_back(l);
}

template <int D>
bool ConstraintSystem<D>::is_solved(const ContactSystem<D>& system, const Island& island,
                                    bool is_rough) const {
  const auto solved = progress_[index_of(island.bodies.front())].solved;
  if (!island.contacts.empty() && island.contacts.back() >= known_contacts_) return false;
  if (is_rough) return solved != Progress::Solved::kNot;
  if (solved != Progress::Solved::kAccurately) return false;
  return (island.has_given_up && !is_convex_) ||
         (std::ranges::all_of(island.contacts,
                              [&](std::size_t c) {
                                const auto& residual = contact_states_[c].residual;
                                return residual.normal <= system.contacts[c].allowed &&
                                       residual.tangential <= slips_allowed[c];
                              }) &&
          std::ranges::all_of(
              island.links, [&](std::size_t l) { return link_residuals_[l] <= links_allowed[l]; }));
}

template <int D>
UnitMotion ConstraintSystem<D>::motion_of(std::int32_t unit,
                                          std::span<const Motion<D>> motions) const {
  UnitMotion result;
  if (unit < 0) return result;
  const auto& motion = motions[static_cast<std::size_t>(unit)];
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (std::size_t i = 0; i < d; ++i) result.displacement[i] = motion[i];
  for (std::size_t i = 0; i < r; ++i) result.turn[3 - r + i] = motion[d + i];
  return result;
}

template <int D>
void ConstraintSystem<D>::move_particles(const ContactSystem<D>& system, const Island& island,
                                         std::span<const Motion<D>> motions) {
  constexpr auto d = static_cast<std::size_t>(D), r = static_cast<std::size_t>(kTurns<D>);
  for (const auto b : island.bodies) {
    const auto particle = system.bodies()[index_of(b)];
    const auto k = index_of(particle);
    if (is_given(particle)) continue;
    const auto motion = motion_of(unit_of_particle_[k], motions);
    Vector moved = motion.displacement;
    if (particles_.bodies.body_of(particle) >= 0)
      moved = displacement_at(motion.displacement, motion.turn, offsets_[k], D);
    for (std::size_t i = 0; i < d; ++i) displacements_[k * d + i] = moved[i];
    for (std::size_t i = 0; i < r; ++i) step_.turns[k * r + i] = motion.turn[3 - r + i];
  }
}

template <int D>
double ConstraintSystem<D>::correct(ContactSystem<D>& system, Island& island,
                                    std::span<const Motion<D>> motions) {
  move_particles(system, island, motions);
  auto& problem = island.problem;
  double largest = 0;
  island.shifts.assign(island.contacts.size() + island.links.size(), 0.0);
  island.shifts_across = island.shifts;
  const auto shift = [&](std::size_t b, std::size_t k, double value) {
    const std::size_t r = problem.blocks[b].row + k;
    const double linear = problem.rows[r].offset + problem.product(r, motions);
    problem.rows[r].offset += value - linear;
    // A contact that is open before and after the change moves nothing.
    const auto& block = problem.blocks[b];
    if (block.is_contact && block.lowest == 0 && problem.impulses[r] == 0 && linear > 0 &&
        value > 0)
      return;
    island.shifts[b] = std::max(island.shifts[b], std::abs(value - linear));
    largest = std::max(largest, std::abs(value - linear) / block.allowed);
  };
  std::size_t b = 0;
  for (const auto c : island.contacts) {
    const auto& contact = system.contacts[c];
    const bool has_body = particles_.bodies.body_of(contact.second) >= 0 ||
                          (contact.first >= 0 && particles_.bodies.body_of(contact.first) >= 0);
    if (has_body || contact.shaped != nullptr || system.uses_distance(contact))
      shift(b, 0, system.gap(contact));
    ++b;
  }
  for (const auto l : island.links) {
    const std::size_t of_link = b++;
    if (links_[l].is_spring()) continue;
    std::vector<UnitMotion> of_units;
    for (const auto& part : links_[l].parts())
      of_units.push_back(is_given(part.particle)
                             ? given_motion(part.particle)
                             : motion_of(unit_of_particle_[index_of(part.particle)], motions));
    const auto values = values_after(links_[l], *step_.links, particles_, times_, of_units);
    for (std::size_t k = 0; k < values.size(); ++k) shift(of_link, k, values[k]);
  }
  return std::max(largest, change_tensions(system, island, motions, false));
}

template <int D>
bool ConstraintSystem<D>::begin_without_contacts(ContactSystem<D>& system, Island& island) {
  auto& problem = island.problem;
  const auto motions = motions_without_contacts(system, island);
  correct(system, island, motions);
  for (std::size_t b = 0; b < island.contacts.size(); ++b) {
    const auto& block = problem.blocks[b];
    if (block.lowest != 0 ||
        problem.rows[block.row].offset + problem.product(block.row, motions) < 0)
      return false;
  }
  std::ranges::fill(problem.impulses, 0.0);
  for (std::size_t b = 0; b < island.links.size(); ++b) {
    const auto& link = links_[island.links[b]];
    const auto& block = problem.blocks[island.contacts.size() + b];
    for (std::size_t k = 0; !block.is_contact && k < block.rows; ++k)
      problem.impulses[block.row + k] = times_.impulse_time * link_forces_[link.first_force + k];
  }
  change_tensions(system, island, motions, true);
  return true;
}

template <int D>
void ConstraintSystem<D>::take_over(ContactSystem<D>& system, const Island& island,
                                    const ConstraintSolution<D>& solution) {
  const auto& problem = island.problem;
  std::size_t b = 0;
  // A residual is that of the last solution plus the correction that would follow.
  for (const auto c : island.contacts) {
    const auto& block = problem.blocks[b];
    const double impulse = problem.impulses[block.row];
    auto& state = contact_states_[c];
    system.contacts[c].impulse = impulse;
    state.friction = {};
    state.solid_load = has_friction(state.tangents) ? load_of_solids(impulse, block.capacity) : 0;
    if (state.solid_load > 0 && has_given_slip(system.contacts[c]))
      state.friction = friction_of_given_slip(system.contacts[c], state);
    for (std::size_t k = 1; k < block.rows; ++k)
      state.friction =
          state.friction + problem.impulses[block.row + k] * state.tangents.directions[k - 1];
    state.residual = residual_of_contact(island, b, solution);
    state.residual.normal += std::max(island.shifts[b], island.shifts_across[b]);
    ++b;
  }
  const auto forces_of = [&](std::size_t l) {
    return std::span(link_forces_).subspan(links_[l].first_force, links_[l].rows.size());
  };
  for (const auto l : island.links) std::ranges::fill(forces_of(l), 0.0);
  for (const auto l : island.links) {
    const auto& link = links_[l];
    const auto& block = problem.blocks[b];
    link_residuals_[l] =
        solution.residuals[b].normal + std::max(island.shifts[b], island.shifts_across[b]);
    if (link.is_angle()) link_residuals_[l] *= mean_radius_;
    // A hinge has one torque, the sum of those of its spring and its stops.
    const bool is_stop = link.kind == LinkEquations::Kind::kStop;
    const double sign = is_stop ? link.parts().front().direction[2] : 1;
    for (std::size_t k = 0; k < block.rows; ++k)
      forces_of(l)[k] += sign * problem.impulses[block.row + k] / times_.impulse_time;
    ++b;
  }
  take_impulses_across(island, solution.motions);
  // Forces of a solution without contacts may be far from those with contacts, and are no guess.
  if (!island.contacts.empty())
    for (const auto l : island.links)
      std::ranges::copy(forces_of(l), &first_link_forces_[links_[l].first_force]);
  for (const auto in_system : island.bodies) {
    const auto body = particles_.bodies.body_of(system.bodies()[index_of(in_system)]);
    if (body < 0) continue;
    auto& step = step_.bodies[index_of(body)];
    step = free_bodies_[index_of(body)];
    const auto motion = motion_of(unit_of_body_[index_of(body)], solution.motions);
    constrain(step, motion.displacement, motion.turn, D);
  }
}

template <int D>
void ConstraintSystem<D>::take_errors(const Island& island, const Refinement<D>* refinement) {
  std::vector<double> of_shifts, unavoidable;
  if (refinement != nullptr) {
    of_shifts = refinement->changes_by(island.shifts);
    unavoidable = refinement->changes_by(errors_of_values(island).second);
  }
  std::size_t b = 0;
  const auto take = [&](ImpulseError& error, double scale) {
    error = {};
    if (refinement != nullptr)
      error = {scale * (refinement->error(b) + of_shifts[b]), scale * unavoidable[b]};
    ++b;
  };
  for (const auto c : island.contacts) take(contact_states_[c].error, 1);
  for (const auto l : island.links)
    take(link_errors_[l], links_[l].is_angle() ? 1 / mean_radius_ : 1);
}

template <int D>
std::pair<std::vector<double>, std::vector<double>> ConstraintSystem<D>::errors_of_values(
    const Island& island) const {
  std::vector<double> allowed, of_values;
  for (const auto c : island.contacts) {
    allowed.push_back(allowed_errors[c]);
    of_values.push_back(rounding[c]);
  }
  for (const auto l : island.links) {
    const std::size_t k = contact_states_.size() + l;
    const double length = links_[l].is_angle() ? mean_radius_ : 1;
    allowed.push_back(allowed_errors[k] * length);
    of_values.push_back(rounding[k] / length);
  }
  return {allowed, of_values};
}

template <int D>
BlockResidual ConstraintSystem<D>::residual_of_contact(
    const Island& island, std::size_t b, const ConstraintSolution<D>& solution) const {
  const auto& problem = island.problem;
  auto block = problem.blocks[b];
  if (is_convex_ || !island.has_given_up || block.rows == 1) return solution.residuals[b];
  block.friction_bound = FrictionBound::kCoulomb;
  return residual_after(problem, block, solution.motions);
}

template <int D>
SolverResult ConstraintSystem<D>::solve(ContactSystem<D>& system, bool is_rough,
                                        double roughly_allowed, int max_iterations) {
  using Solved = typename Progress::Solved;
  assert(contact_states_.size() == system.contacts.size());
  assert(slips_allowed.size() == contact_states_.size() && links_allowed.size() == links_.size());
  assert(allowed_errors.size() == contact_states_.size() + links_.size());
  assert(rounding.size() == allowed_errors.size());
  find_islands(system);
  progress_.resize(system.bodies().size());
  SolverResult result;
  has_given_up_ = needs_shorter_step_ = false;
  for (auto& island : islands_) {
    Progress progress;
    for (const auto b : island.bodies)
      progress.iterations = std::max(progress.iterations, progress_[index_of(b)].iterations);
    if (!is_solved(system, island, is_rough)) {
      const auto solved = IslandLadder<D>(*this, system, island, is_rough, roughly_allowed,
                                          max_iterations - progress.iterations)
                              .solve();
      result.stages += solved.stages;
      progress.iterations += solved.iterations;
      progress.solved = is_rough               ? Solved::kRoughly
                        : solved.residual <= 1 ? Solved::kAccurately
                                               : Solved::kNot;
      // Iterations of a solution without contacts do not count for later ones with contacts.
      auto of_bodies = progress;
      if (island.contacts.empty() && solved.residual <= 1) of_bodies.iterations = 0;
      for (const auto b : island.bodies) progress_[index_of(b)] = of_bodies;
      result.residual = largest_or_nan(result.residual, solved.residual);
    }
    result.iterations = std::max(result.iterations, progress.iterations);
    has_given_up_ |= island.has_given_up;
    needs_shorter_step_ |= island.needs_shorter_step;
  }
  known_contacts_ = system.contacts.size();
  std::ranges::copy(link_forces_, step_.link_forces.begin());
  return result;
}

template <int D>
void ConstraintSystem<D>::keep_motions_without_contacts(const ContactSystem<D>& system,
                                                        const Island& island,
                                                        std::span<const Motion<D>> motions) {
  without_contacts_.resize(system.bodies().size());
  for (const auto b : island.bodies) {
    const auto unit = unit_of_particle_[index_of(system.bodies()[index_of(b)])];
    if (unit >= 0) without_contacts_[index_of(b)] = motions[index_of(unit)];
  }
}

template <int D>
std::vector<double> ConstraintSystem<D>::least_violations() const {
  const std::size_t contacts = contact_states_.size();
  std::vector<double> all(contacts + links_.size());
  for (const auto& island : islands_) {
    if (island.problem.blocks.empty()) continue;
    const auto of_blocks = viscontact::contact_solver::least_violations(island.problem);
    for (std::size_t b = 0; b < island.contacts.size(); ++b) all[island.contacts[b]] = of_blocks[b];
    for (std::size_t b = 0; b < island.links.size(); ++b) {
      const auto l = island.links[b];
      all[contacts + l] =
          of_blocks[island.contacts.size() + b] * (links_[l].is_angle() ? mean_radius_ : 1);
    }
  }
  return all;
}
template class ConstraintSystem<2>;
template class ConstraintSystem<3>;

}  // namespace viscontact::particles
