// Steps of docs/physics.md (5.3), divided into parts where particles are fast.
#include "viscontact/contact_dynamics/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "viscontact/common/error.hpp"
#include "viscontact/common/system/thread_pool.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/contact_dynamics/impacts/impacts.hpp"
#include "viscontact/contact_dynamics/projection/step_projection.hpp"
#include "viscontact/membranes/membrane_shape.hpp"
#include "viscontact/particles/contact/film_tension.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/state/particles.hpp"
#include "viscontact/particles/state/rigid_bodies.hpp"
#include "viscontact/particles/steps/step_report.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {

namespace {

struct DivisionTuning {
  // How often a step may be halved because its friction is not solved. 500 to 2000 spheres with
  // mu_s up to 1 need at most five parts, radii in the ratio 10 with mu_s = 1 up to ten.
  static constexpr int kMostOfFriction = 6;
  // Iterations of a step times its listed pairs, after which its parts are divided no further, which
  // bounds the time: 2000 spheres took at most 28 000 iterations in a step, and then 1.7 s.
  static constexpr double kMostVisits = 2e8;
};

struct OverlapTuning {
  // The overlap of a step that jams, in mean radii. Steps that fail for another reason, such as
  // their friction, leave overlaps of up to 3e-3 in data/cases/particles/shear_under_pressure.toml.
  static constexpr double kJam = 0.01;
};

/// Length of the displacement of particle k [L]. Throws Error(kNotConverged) if a component of the
/// displacement or of the position exceeds `largest` [L] in magnitude or is not a number.
double checked_length(const Particles& p, const std::vector<double>& displacements, std::size_t k,
                      double largest, double time) {
  const Vector x = p.position(k), w = point_of(displacements.data(), k, p.dimension);
  for (std::size_t d = 0; d < 3; ++d)
    if (!(std::abs(x[d]) <= largest && std::abs(w[d]) <= largest))
      throw Error(ErrorKind::kNotConverged,
                  fmt::format("particle {} is at {} and moves by {} in the step to time {}, too "
                              "far for the precision of a double; check its forces and the time "
                              "step",
                              p.id(k), x[d], w[d], time));
  return norm(w);
}

}  // namespace

Simulation::Simulation(Setting setting, State state, int threads)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      pouring_(setting_.sources, state_),
      mean_radius_(mean_radius(state_.particles)),
      has_other_shapes_(state_.particles.has_other_shapes()),
      first_time_(state_.time),
      pool_(std::make_unique<ThreadPool>(threads)),
      obstacles_(obstacles_of(setting_)),
      grid_(setting_.time_step, setting_.scheme == Scheme::kLeapfrog, jump_times(setting_)) {
  assert(!setting_.fluid);
  assert(!has_other_shapes_ || (state_.particles.dimension == 2 && state_.particles.turn() &&
                                !setting_.laws.restitution.is_on()));
  assert(state_.particles.dimension == 2 || state_.particles.dimension == 3);
  assert(threads >= 1);
  assert(state_.particles.positions.size() ==
         state_.particles.count() * index_of(state_.particles.dimension));
  assert(state_.particles.velocities.size() == state_.particles.positions.size());
  assert(state_.particles.masses.size() == state_.particles.count());
  assert(std::ranges::none_of(state_.particles.masses, [](double mass) { return mass < 0; }));
  const auto is_loaded = [](const Plane& plane) { return plane.load.has_value(); };
  if (std::ranges::any_of(setting_.planes, is_loaded)) {
    state_.planes.resize(setting_.planes.size());
    for (const auto& obstacle : obstacles_) loaded_.push_back(is_loaded(obstacle) ? 0 : -1);
  } else {
    state_.planes.clear();
  }
  place_planes();
  if (state_.given_loads.empty())
    for (const auto& [particle, motion] : setting_.given_motions)
      state_.given_loads.push_back({particle});
  state_.particles.cell = cell_of(setting_.domain);
  join_neighbours(setting_.links.membranes, state_.particles);
  wrap_into_cell(state_);
  if (state_.steps > 0) check_shapes(setting_.links.membranes, state_.particles);
  if (setting_.sources.empty()) return;
  // Memory for all particles that sources will add is reserved now, so that the arrays never move,
  // and callers may keep views of them.
  auto& p = state_.particles;
  auto most = p.count();
  for (const auto& source : setting_.sources) most += source.due(source.end);
  const auto n = static_cast<std::size_t>(p.dimension);
  for (auto* numbers : {&p.positions, &p.velocities, &p.angular_velocities})
    numbers->reserve(3 * most);
  for (auto* numbers : {&p.radii, &p.masses, &p.angles, &p.inertias}) numbers->reserve(most);
  p.orientations.reserve(4 * most);
  p.ids.reserve(most);
  setting_.added_forces.reserve(n * most);
  setting_.added_torques.reserve(3 * most);
  if (state_.steps == 0) pour();
}

void Simulation::pour() {
  if (setting_.sources.empty()) return;
  pouring_.pour(setting_, state_);
  mean_radius_ = mean_radius(state_.particles);
  if (!setting_.added_forces.empty()) added_forces();
  if (!setting_.added_torques.empty()) added_torques();
}

bool Simulation::pull_across(std::span<Pair* const> pairs, std::span<const double> impulses) const {
  const auto kappas = kappas_of_films(
      state_.particles, mobilities_,
      pairs.size(), [&](std::size_t f) -> auto& { return *pairs[f]; },
      [&](std::size_t f) { return impulses[f]; });
  return !kappas.empty() && share_of_film(std::ranges::max(kappas)) > 0;
}

bool Simulation::pulled_across() const {
  return !state_.memories.empty() && std::ranges::any_of(state_.pairs, [&](const Pair& pair) {
    return norm(state_.memories.of(pair.memory).across()) > 0;
  });
}

void Simulation::take_impulses(const ProjectionResult& projected) {
  assert(projected.impulses.size() == projected.pairs.size());
  assert(projected.memories.empty() || projected.memories.size() == projected.pairs.size());
  for (std::size_t f = 0; f < projected.pairs.size(); ++f) {
    auto& pair = *projected.pairs[f];
    pair.impulse = projected.impulses[f];
    if (!projected.memories.empty()) state_.memories.set(pair.memory, projected.memories[f]);
  }
}

std::size_t Simulation::remember(const ProjectionResult& projected, double h) {
  assert(projected.residuals.impulse_errors.size() == projected.pairs.size());
  std::size_t glued = 0;
  for (std::size_t f = 0; f < projected.pairs.size(); ++f) {
    auto& pair = *projected.pairs[f];
    const auto radii =
        projected.radii.empty() ? radii_of(pair, state_.particles, obstacles_) : projected.radii[f];
    setting_.laws.remember(pair, state_.memories, radii, projected.residuals.impulse_errors[f], h);
    if (pair.gamma < 0) ++glued;
  }
  return glued;
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;

void Simulation::move(double h) {
  assert(h > 0);
  auto& p = state_.particles;
  pool_->for_blocks(p.positions.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      p.positions[k] += displacements_[k];
      p.velocities[k] = displacements_[k] / h;
    }
  });
  if (p.turn()) turn_particles(p, std::span(turns_).first(p.angular_velocities.size()), h);
  for (std::size_t w = 0; w < loaded_.size(); ++w) {
    if (loaded_[w] < 0) continue;
    auto& motion = state_.planes[w - walls_of_domain()];
    const double moved = dot(obstacles_[w].start.normal,
                             point_of(displacements_.data(), index_of(loaded_[w]), p.dimension));
    motion.displacement += moved;
    motion.velocity = moved / h;
  }
  if (!loaded_.empty()) place_planes();
  for (std::size_t b = 0; b < body_steps_.size(); ++b)
    move_body(p.bodies.bodies[b], body_steps_[b], h, p.dimension);
  if (!body_steps_.empty()) place_members(p);
}

template <int D>
ProjectionResult Simulation::project(double h, double next, bool can_be_divided) {
  const auto planes_before = positions_of(obstacles_, state_.time);
  const auto planes = positions_of(obstacles_, next);
  const double largest = largest_resolved_distance(setting_.solver.tolerance, mean_radius_);
  const auto length_of = [&](std::size_t k) {
    return checked_length(state_.particles, displacements_, k, largest, next);
  };
  const auto longest_of = [&](std::size_t begin, std::size_t end) {
    MaximumOfBlocks longest;
    for (std::size_t k = begin; k < end; ++k) longest.value = std::max(longest.value, length_of(k));
    return longest;
  };
  // The longest displacement of a plane under a load [L].
  const auto gone_planes = [&] {
    double gone = 0;
    for (const auto entry : loaded_) {
      if (entry < 0) continue;
      const double length = norm(point_of(displacements_.data(), index_of(entry), D));
      if (!(length <= largest))
        throw Error(ErrorKind::kNotConverged,
                    "a plane under a load moves by {} in the step to time {}, too far for the "
                    "precision of a double; check its force and the time step",
                    length, next);
      gone = std::max(gone, length);
    }
    return gone;
  };
  // Only particles closer to an obstacle than `margin` [L] are listed. Neither term of the margin
  // changes the result, because the loop below repeats the projection with a longer margin if a
  // particle moves further.
  const double longest =
      pool_->sum_of_blocks<MaximumOfBlocks>(state_.particles.count(), longest_of).value +
      gone_planes();
  double margin = std::max(2 * longest, mean_radius_ / 4);
  if (!neighbour_list_is_valid(state_, displacements_, *pool_)) {
    state_.skins.clear();
    rebuild_neighbour_list(state_, displacements_, *pool_);
    state_.memories.keep_only(state_.pairs, state_.walls);
  }
  bool is_constrained = has_constraints() || pulled_across();
  bool can_have_springs = true;                      // films, across their pairs
  SolverResult discarded;                            // iterations and stages
  std::vector<double> no_turns, no_turn_mobilities;  // of particles that do not turn
  for (;;) {
    rebuild_wall_list(state_, planes, margin, *pool_);
    if (has_other_shapes_) {
      list_present_contacts(state_.pairs, state_.particles, planes);
      list_present_contacts(state_.walls, state_.particles, planes);
    }
    find_impacts<D>(h, next);
    StepProjection<D> projection(state_, h, planes_before, planes, displacements_, mobilities_,
                                 *pool_, loaded_);
    const bool turns = state_.particles.turn();
    if (is_constrained && !turns) {
      // Units need mobilities of turns, of any size, also if nothing turns.
      no_turns.assign(mobilities_.size() * turn_components(D), 0.0);
      no_turn_mobilities = mobilities_;
      for (auto& w : no_turn_mobilities) w /= mean_radius_ * mean_radius_;
    }
    const ConstraintStep constraints{setting_.laws,
                                     obstacles_,
                                     state_.time,
                                     next,
                                     is_first_part(),
                                     impulse_time_of(h),
                                     turns ? turns_ : no_turns,
                                     turns ? turn_mobilities_ : no_turn_mobilities,
                                     body_steps_,
                                     &setting_.links,
                                     link_forces_,
                                     works_across_};
    if (is_constrained) projection.add_constraints(constraints);
    if (impacts<D>()) projection.follow(*impacts<D>());
    const bool was_constrained = is_constrained;
    auto projected = projection.solve(setting_.solver, mean_radius_, can_be_divided);
    // A chain that is squeezed until it buckles may have a solution without springs only.
    const bool springs_fail =
        is_constrained && !has_constraints() && !projected.residuals.converged;
    can_have_springs = can_have_springs && !springs_fail;
    is_constrained =
        has_constraints() ||
        (can_have_springs && (is_constrained || pull_across(projected.pairs, projected.impulses)));
    if (is_constrained != was_constrained) {
      discarded.iterations += projected.iterations;
      discarded.stages += projected.stages;
      undo_impacts();
      move_freely<D>(h, next);
      continue;
    }
    double gone = 0;
    for (const auto body : projected.bodies)
      if (index_of(body) < state_.particles.count())
        gone = std::max(gone, length_of(index_of(body)));
    if (impacts<D>())
      for (const auto body : impacts<D>()->touched())
        gone = std::max(gone, length_of(index_of(body)));
    gone += gone_planes();
    if (projected.needs_shorter_step ||
        (gone <= margin && neighbour_list_is_valid(state_, displacements_, *pool_))) {
      projected.lacks_springs = !can_have_springs;
      projected.iterations += discarded.iterations;
      projected.stages += discarded.stages;
      return projected;
    }
    // The impulses moved particles further than the lists of pairs allow for, so that pairs may be
    // missing. Therefore the projection is repeated with longer lists. The loop ends because the
    // margin and the skins (distances up to which pairs are listed) only grow. The new impulses are
    // the first guess of the repeated projection, with two exceptions. With restitution, the
    // computation of impacts needs to know which pairs bore a load in the step before. The convex
    // relaxation of friction needs no first guess, and where there are films, its friction depends
    // on the impulses of the step before.
    const auto& friction = setting_.laws.friction;
    const bool is_convex = friction && friction->method == FrictionMethod::kConvex;
    if (!setting_.laws.restitution.is_on() && !is_convex) {
      if (saved_impulses_.empty() && !before_division_) saved_impulses_.copy(state_);
      take_impulses(projected);
    }
    margin = std::max(margin, 2 * gone);
    undo_impacts();
    rebuild_neighbour_list(state_, displacements_, *pool_);
    move_freely<D>(h, next);
  }
}

void Simulation::add_works_of_arms(double h) {
  // The work of an impulse is the impulse times the mean of the rates at which the arm grows before
  // and after it.
  const auto& p = state_.particles;
  const auto before = [&](std::int32_t particle) -> UnitMotion {
    const auto b = p.bodies.body_of(particle);
    if (b < 0) return {p.velocity(index_of(particle)), {}};
    const auto& body = p.bodies.bodies[index_of(b)];
    return {body.velocity, body.angular_velocity};
  };
  const auto after = [&](std::int32_t particle) -> UnitMotion {
    const auto b = p.bodies.body_of(particle);
    if (b < 0)
      return {1 / h * point_of(displacements_.data(), index_of(particle), p.dimension), {}};
    const auto& step = body_steps_[index_of(b)];
    return {1 / h * step.displacement, 1 / h * step.turn};
  };
  for (std::size_t k = 0; k < arm_works_.size(); ++k) {
    const auto& arm = setting_.links.arms[k];
    const double impulse =
        impulse_time_of(h) * link_forces_[setting_.links.place_of_arm(k, p.dimension)];
    arm_works_[k] += works_across_[k];
    arm_works_[k] += impulse / 2 *
                     (rate_of_arm(arm, p, before(arm.first), before(arm.second)) +
                      rate_of_arm(arm, p, after(arm.first), after(arm.second)));
  }
}

template <int D>
void Simulation::find_impacts(double h, double next) {
  impacts<D>().reset();
  if (!setting_.laws.restitution.is_on()) return;
  const ImpactStep step{setting_.laws,
                        obstacles_,
                        state_.time,
                        next,
                        h,
                        impulse_time_of(h),
                        setting_.solver.tolerance * mean_radius_,
                        displacements_,
                        mobilities_,
                        turns_,
                        turn_mobilities_,
                        body_steps_};
  impacts<D>() = std::make_unique<Impacts<D>>(state_, step);
  impacts<D>()->run();
}

void Simulation::undo_impacts() {
  if (impacts_in_plane_) impacts_in_plane_->undo();
  if (impacts_in_space_) impacts_in_space_->undo();
  impacts_in_plane_.reset();
  impacts_in_space_.reset();
}

template <int D>
void Simulation::accept(const ProjectionResult& projected, double h, double next,
                        StepReport& report) {
  // A pair that bore friction without a normal impulse in the step before can be missing in this
  // projection. The friction of such a pair is then 0.
  for (auto* pairs : {&state_.pairs, &state_.walls})
    for (auto& pair : *pairs) {
      if (pair.memory == PairMemories::kNone) continue;
      auto& memory = state_.memories.make(pair.memory);
      if (pair.impulse == 0) memory.set_friction({});
      // A step without constraints has no memories that take the place of these.
      if (pair.impulse == 0 || projected.memories.empty()) memory.set_across({});
    }
  const auto [names, impulse] = pressing(projected, next);
  report.given_load += impulse;
  report.jams =
      report.jams || (!names.empty() && !projected.residuals.converged &&
                      -projected.residuals.smallest_gap > OverlapTuning::kJam * mean_radius_);
  if (!names.empty()) report.pressing = names;
  take_impulses(projected);
  report.glued = remember(projected, h);
  const double impulse_time = impulse_time_of(h);
  for (std::size_t k = 0; k < link_forces_.size(); ++k)
    link_impulses_[k] += impulse_time * link_forces_[k];
  link_time_ += impulse_time;
  state_.link_forces = link_forces_;
  add_works_of_arms(h);
  add_given_loads(projected, h);
  move(h);
  if (impacts<D>()) {
    impacts<D>()->add_lags(state_.particles);
    if (!body_steps_.empty()) place_members(state_.particles);
    report.iterations += impacts<D>()->iterations();
    stages_ += impacts<D>()->stages();
    if (!impacts<D>()->converged()) {
      report.converged = false;
      report.excess = std::numeric_limits<double>::infinity();
    }
    const auto& rebounds = impacts<D>()->rebounds();
    rebounds_.insert(rebounds_.end(), rebounds.begin(), rebounds.end());
    const auto& impulses = impacts<D>()->impulses();
    impact_impulses_.insert(impact_impulses_.end(), impulses.begin(), impulses.end());
    impacts<D>().reset();
  }
  state_.time = next;
  if (setting_.scheme == Scheme::kLeapfrog) state_.velocity_lag = h / 2;
  ++report.parts;
  report.contacts = projected.pairs.size();
  report.unresolved += projected.unresolved;
  report.lacks_springs = report.lacks_springs || projected.lacks_springs;
  report.buckling = std::max(report.buckling, projected.buckling);
  report.has_given_loads = report.has_given_loads || projected.has_given_loads;
  report.iterations += projected.iterations;
  stages_ += projected.stages;
  report_residuals(projected.residuals, mean_radius_, report);
}

void Simulation::examine(const ProjectionResult& projected, double next) const {
  const auto& residuals = projected.residuals;
  refuse_deep_overlap(residuals, state_.particles, setting_, mean_radius_, next, [&] {
    const auto names = pressing(projected, next).names;
    if (names.empty()) return std::string("is the time step too long for the forces?");
    return fmt::format("do {} leave the others too little room?", names);
  });
  refuse_meeting(next);
  if (residuals.converged || projected.unsolved_links.empty() ||
      std::max(projected.link_residual, -residuals.smallest_gap) <= kBroken * mean_radius_)
    return;
  std::string names;
  constexpr std::size_t kMostNames = 6;  // in the message
  const auto& all = projected.unsolved_links;
  for (std::size_t k = 0; k < std::min(all.size(), kMostNames); ++k)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", all[k]);
  if (all.size() > kMostNames) names += fmt::format(" and {} more", all.size() - kMostNames);
  if (residuals.smallest_gap < 0 && projected.contact_contradicts)
    names += " without an overlap of " +
             name_of_pair(residuals.deepest_overlap, state_.particles, setting_);
  throw Error(ErrorKind::kNotConverged,
              fmt::format("the constraints of the step to time {} contradict each other: no motion "
                          "satisfies {}; change their lengths or places, or leave one out{}",
                          next, names,
                          setting_.links.membranes.empty()
                              ? ""
                              : "; a membrane may need a shorter time_step, a smaller "
                                "bending_rigidity, or inner_area = \"free\""));
}

template <int D>
void Simulation::advance(double h, double next, int halvings, StepReport& report) {
  assert(h > 0 && halvings <= kMostHalvings);
  move_freely<D>(h, next);
  const double visits =
      double(report.iterations) * double(state_.pairs.size() + state_.walls.size());
  const bool may_divide_friction =
      halvings < DivisionTuning::kMostOfFriction && visits < DivisionTuning::kMostVisits;
  const auto projected = project<D>(h, next, may_divide_friction);
  // Links that only seem to contradict each other because they turn too far hold in shorter steps.
  const bool is_divided =
      projected.needs_shorter_step ||
      (halvings < kMostHalvings &&
       (projected.residuals.converged ? projected.unresolved > 0 : projected.turns_too_far));
  if (!is_divided) examine(projected, next);
  if (is_divided) {
    undo_impacts();
    if (halvings == 0) before_division_ = state_;
    if (projected.residuals.converged) take_impulses(projected);
    const double middle = state_.time + h / 2;
    report.iterations += projected.iterations;
    stages_ += projected.stages;
    // A first guess for a part of half of the length.
    scale_impulses(0.5, state_);
    advance<D>(h / 2, middle, halvings + 1, report);
    advance<D>(h / 2, next, halvings + 1, report);
    // The next part may have twice the length. Its first guess is then twice these impulses.
    if (halvings > 0) scale_impulses(2, state_);
    return;
  }
  accept<D>(projected, h, next, report);
  if (halvings > 0) impulses_of_parts_.add(state_);
}

template <int D>
void Simulation::advance_whole(double h, double next, StepReport& report) {
  try {
    advance<D>(h, next, 0, report);
  } catch (...) {
    impulses_of_parts_.clear();
    rebounds_.clear();
    impact_impulses_.clear();
    undo_impacts();
    if (before_division_) {
      state_ = *before_division_;  // copied, so that the arrays keep their places in memory
      place_planes();
    } else if (!saved_impulses_.empty()) {
      saved_impulses_.restore(state_);
    }
    before_division_.reset();
    saved_impulses_.clear();
    throw;
  }
  before_division_.reset();
  saved_impulses_.clear();
}

StepReport Simulation::step(double end) {
  const auto interval = grid_.next(state_, end);
  if (!interval) return {.time = state_.time};
  const auto& p = state_.particles;
  StepReport report{.time = interval->end};
  stages_ = {};
  rebounds_.clear();
  link_impulses_.assign(setting_.links.force_count(p.dimension), 0.0);
  link_time_ = 0;
  arm_works_.assign(setting_.links.arms.size(), 0.0);
  given_impulses_.clear();
  for (const auto& [particle, motion] : setting_.given_motions)
    given_impulses_.push_back({particle});
  if (p.dimension == 2)
    advance_whole<2>(interval->h, interval->end, report);
  else
    advance_whole<3>(interval->h, interval->end, report);
  if (!impulses_of_parts_.empty()) {
    impulses_of_parts_.give_to(state_);
    impulses_of_parts_.clear();
  }
  for (std::size_t k = 0; k < link_impulses_.size(); ++k)
    state_.link_forces[k] = link_impulses_[k] / link_time_;
  report.given_load /= interval->h;
  state_.impact_impulses = std::exchange(impact_impulses_, {});
  state_.given_loads = given_impulses_;
  for (auto& load : state_.given_loads) {
    load.force = (1 / interval->h) * load.force;
    load.torque = (1 / interval->h) * load.torque;
  }
  state_.arm_powers = arm_works_;
  for (auto& power : state_.arm_powers) power /= interval->h;
  state_.earlier_step = interval->h;
  wrap_into_cell(state_);
  StepGrid::count(state_, *interval);
  pour();
  report.solver_stages = text_of(stages_);
  return report;
}

}  // namespace viscontact::particles
