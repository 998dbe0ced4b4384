// Lists pairs that are close to contact, makes the contacts of a step and measures their residuals.
#include "viscontact/immersed/contacts/fluid_contacts.hpp"

#include <cassert>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <optional>

#include "viscontact/common/error.hpp"
#include "viscontact/constraint_rows/link_rows.hpp"
#include "viscontact/constraint_rows/selection.hpp"
#include "viscontact/constraint_rows/solver_names.hpp"
#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"
#include "viscontact/particles/neighbours/close_pairs.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the contacts of a step.
struct FluidContactTuning {
  // Particles are found by circles around them that overlap, whose radii must be below half a
  // period, because only the nearest images of particles have a number (periods.hpp).
  static constexpr double kShareOfPeriod = 0.499;
  // Each correction multiplies the error by about the angle [rad] by which particles turn in the
  // step, so that few corrections are needed.
  static constexpr int kMostCorrections = 20;
  // Turns [rad] of a particle that touches: beyond 1 the corrections for them diverge, and an
  // ellipse was left with half of its size in the floor.
  static constexpr double kMostTurn = 1;
};

/// Sorts `pairs` by order_of(), the order of files of contacts and of restart files. Those that are
/// also in `before`, the list of the step before, get their memory from it; the pairs of `before`
/// with gamma < 0 are added.
void keep_memory(std::vector<Pair>& pairs, std::vector<Pair> before) {
  std::ranges::sort(pairs, {}, order_of);
  std::ranges::sort(before, {}, order_of);
  std::erase_if(before, [&](const Pair& old) {
    return !(old.gamma < 0) && !std::ranges::binary_search(pairs, order_of(old), {}, order_of);
  });
  // set_union() takes a pair that is in both from the first list.
  std::vector<Pair> merged;
  std::ranges::set_union(before, pairs, std::back_inserter(merged), {}, order_of, order_of);
  pairs = std::move(merged);
}

/// Lists all pairs with a distance of their surfaces below `reach` [L] and those with gamma < 0. On
/// an axis the side of a cylinder is left out.
void list_pairs(StepContacts& step, const State& state, std::span<const PlanePosition> obstacles,
                double reach, ThreadPool& pool) {
  const auto& p = state.particles;
  std::vector<double> extents = p.radii;
  double furthest = std::numeric_limits<double>::infinity();
  for (const double length : p.cell.lengths)
    if (length > 0) furthest = std::min(furthest, FluidContactTuning::kShareOfPeriod * length);
  for (auto& extent : extents) extent = std::max(extent, std::min(extent + reach / 2, furthest));
  const auto close = p.cell.is_periodic()
                         ? close_pairs_in_period(p.cell, p.positions, extents, pool)
                         : close_pairs(p.dimension, p.positions, extents, pool);
  for (const auto& pair : close) {
    if (p.bodies.are_one(pair.first, pair.second)) continue;
    Pair made{pair.first, pair.second};
    made.image = pair.image;
    add_contacts_of(p, made, obstacles, step.pairs);
  }
  for (std::size_t w = 0; w < obstacles.size(); ++w) {
    if (p.dimension == 1 && obstacles[w].normal[0] == 0) continue;
    for (std::size_t k = 0; k < p.count(); ++k) {
      if (!(gap(obstacles[w], p.position(k), p.radii[k]) < reach)) continue;
      add_contacts_of(p, {-1 - static_cast<std::int32_t>(w), static_cast<std::int32_t>(k)},
                      obstacles, step.walls);
    }
  }
  keep_memory(step.pairs, at_present_places(state.pairs, p, obstacles));
  keep_memory(step.walls, at_present_places(state.walls, p, obstacles));
}

/// The contact of a pair, with the distance of the surfaces as its gap, where friction acts, and
/// the circles of the surfaces.
struct MadeContact {
  Contact<2> contact;
  FrictionPlace place{};
  ContactCircles circles{};
};

/// Radius of the first surface for the laws of contacts.
double radius_of_obstacle(const PlanePosition& obstacle) {
  return obstacle.is_curved() ? -obstacle.radius : std::numeric_limits<double>::infinity();
}

MadeContact contact_of_shapes(const Particles& p, const Pair& pair,
                              std::span<const PlanePosition> obstacles) {
  const auto surfaces = ShapedContacts(p, pair, obstacles).at(p, pair, obstacles);
  MadeContact made{{std::max(pair.first, -1), pair.second, surfaces.normal, surfaces.gap,
                    pair.gamma, pair.impulse}};
  made.contact.levers = surfaces.levers();
  made.place.arms = surfaces.friction_arms();
  made.circles.arms = {dot(surfaces.arms[0], surfaces.normal),
                       dot(surfaces.arms[1], surfaces.normal)};
  made.circles.radii = {surfaces.radii[0], surfaces.radii[1]};
  if (pair.first >= 0) {
    made.contact.image = pair.image;
    return made;
  }
  made.contact.obstacle = -1 - pair.first;
  made.place.on_obstacle = {surfaces.on_obstacle[0], surfaces.on_obstacle[1], 0};
  made.circles.radii = radii_of(surfaces, &obstacles[pair.plane()]);
  return made;
}

/// A tangent takes the place of a round wall, where the particle comes with its velocity without
/// contact.
MadeContact contact_in_fluid(const Particles& p, const Pair& pair,
                             std::span<const PlanePosition> obstacles,
                             const ContactConditions& conditions) {
  if (!is_round(p, pair)) return contact_of_shapes(p, pair, obstacles);
  const auto k = index_of(pair.second);
  const double first =
      pair.first < 0 ? radius_of_obstacle(obstacles[pair.plane()]) : p.radii[index_of(pair.first)];
  MadeContact made{{}, {}, {{first, p.radii[k]}}};
  if (p.dimension == 1) {
    const auto on_axis = contact_of<1>(p, pair, obstacles);
    made.contact = {on_axis.first, on_axis.second, {on_axis.normal[0], 0}};
    made.contact.gap = on_axis.gap;
    made.contact.lowest = on_axis.lowest;
    made.contact.obstacle = on_axis.obstacle;
    made.contact.impulse = on_axis.impulse;
    return made;
  }
  if (pair.first >= 0) {
    made.contact = contact_of<2>(p, pair, obstacles);
    const double share = 1 + made.contact.gap / (first + p.radii[k]);
    made.place.arms = {share * first, share * p.radii[k]};
    return made;
  }
  auto obstacle = obstacles[pair.plane()];
  if (obstacle.is_curved()) {
    const double* velocity = &conditions.free_velocities[conditions.layout.at(pair.second, 0)];
    const Vector moved{conditions.h * velocity[0], conditions.h * velocity[1], 0};
    obstacle = tangent_at(obstacle, p.position(k) + moved);
  }
  made.contact = contact_of<2>(p, pair, obstacle);
  made.place.arms = {0, p.radii[k]};
  const auto& normal = made.contact.normal;
  made.place.on_obstacle =
      p.position(k) - (p.radii[k] + made.contact.gap) * Vector{normal[0], normal[1], 0};
  return made;
}

void make_contacts(StepContacts& step, const Particles& p, const Fluid& fluid,
                   std::span<const PlanePosition> obstacles, const ContactConditions& conditions,
                   const FrictionOfStep* friction) {
  for (const auto* list : {&step.pairs, &step.walls})
    for (const auto& pair : *list) {
      auto [contact, place, circles] = contact_in_fluid(p, pair, obstacles, conditions);
      step.circles.push_back(circles);
      if (friction != nullptr) {
        auto one =
            friction_of_contact(*friction, p, pair, contact, place, circles.radii, conditions);
        one.contact = step.contacts.size();
        if (std::isfinite(one.capacity)) step.frictions.push_back(one);
      }
      contact.gap -= fluid.threshold_gap;
      contact.lowest /= conditions.share_of_impulse;
      contact.impulse /= conditions.share_of_impulse;
      // A distance that differs from the threshold gap by less than half of the tolerance counts
      // as equal to it.
      if (std::abs(contact.gap) <= conditions.solver.tolerance * conditions.mean_radius / 2)
        contact.gap = 0;
      // In a sheared cell an image of a particle moves relative to the particle.
      if (pair.first >= 0 && pair.image != 0) {
        const auto velocity = velocity_of_image(p.cell, pair.image);
        contact.gap +=
            conditions.h * (contact.normal[0] * velocity[0] + contact.normal[1] * velocity[1]);
      }
      step.contacts.push_back(contact);
    }
}

Particles moved(const Particles& p, std::span<const double> velocities, double h,
                const MotionLayout& layout) {
  auto result = p;
  for (std::size_t k = 0; k < p.count(); ++k) {
    const auto at = layout.at(static_cast<std::int32_t>(k), 0);
    for (std::size_t d = 0; d < 2; ++d) result.positions[2 * k + d] += h * velocities[at + d];
    result.angles[k] += h * velocities[at + 2];
  }
  return result;
}

/// Corrects the gaps of contacts of particles that are not round, which turn by finite angles in
/// the step, by the difference between the true gap after the step and the linearised one. Returns
/// false, and changes nothing, if this difference is at most a quarter of the tolerance for each
/// contact that may act.
bool correct_turns(StepContacts& step, const Particles& p, const Fluid& fluid,
                   std::span<const PlanePosition> obstacles, const ContactConditions& conditions) {
  const double h = conditions.h;
  const auto after = moved(p, step.velocities, h, conditions.layout);
  std::vector<double> changes(step.contacts.size());
  double largest = 0;
  for (std::size_t c = 0; c < step.pairs.size() + step.walls.size(); ++c) {
    const auto& contact = step.contacts[c];
    const auto n = step.pairs.size();
    const auto& pair = c < n ? step.pairs[c] : step.walls[c - n];
    if (is_round(p, pair)) continue;
    // make_contacts() sets a gap within half of the tolerance to 0; the gap after the step is
    // changed by as much.
    const ShapedContacts contacts(p, pair, obstacles);
    const auto gap_at = [&](const Particles& at) {
      return contacts.at(at, pair, obstacles).gap - fluid.threshold_gap;
    };
    double gap = gap_at(after);
    const double before = gap_at(p);
    if (std::abs(before) <= conditions.solver.tolerance * conditions.mean_radius / 2) gap -= before;
    changes[c] = gap - gap_after(contact, step.velocities.data(), h, conditions.layout);
    if (contact.w != kImmovable && (gap < 0 || contact.impulse != 0 || contact.lowest < 0))
      largest = std::max(largest, std::abs(changes[c]));
  }
  if (largest <= conditions.solver.tolerance * conditions.mean_radius / 4) return false;
  for (std::size_t c = 0; c < changes.size(); ++c) step.contacts[c].gap += changes[c];
  return true;
}

/// Throws Error(kNotConverged) if a particle without sides that is not round and bears a force
/// turns so far in the step that corrections of its gaps for the turn have no meaning.
void check_turns(const StepContacts& step, const Particles& p,
                 const ContactConditions& conditions) {
  if (!p.has_other_shapes()) return;
  for (std::size_t c = 0; c < step.pairs.size() + step.walls.size(); ++c) {
    if (step.contacts[c].impulse == 0) continue;
    for (const auto particle : {step.contacts[c].first, step.contacts[c].second}) {
      // The contacts of shapes with sides follow their corners, whose circles turns do not change.
      if (particle < 0 || p.is_round(index_of(particle)) || p.shape(index_of(particle)).sides() > 0)
        continue;
      const double turn =
          conditions.h * std::abs(step.velocities[conditions.layout.at(particle, 2)]);
      if (turn > FluidContactTuning::kMostTurn)
        throw Error(ErrorKind::kNotConverged,
                    "the {} {} would turn by {:.3g} rad in the step while it touches; at most "
                    "{:.3g} rad can be resolved, so that a shorter time step helps",
                    p.shape(index_of(particle)).name(), p.id(index_of(particle)), turn,
                    FluidContactTuning::kMostTurn);
    }
  }
}

/// Throws Error(kNotConverged) if two particles with sides are closer after the step than the
/// tolerance allows, at a place that was no contact at its beginning.
void check_sides_apart(const StepContacts& step, const Particles& p, const Fluid& fluid,
                       const ContactConditions& conditions) {
  if (!p.has_other_shapes()) return;
  const auto after = moved(p, step.velocities, conditions.h, conditions.layout);
  const double allowed = 2 * conditions.solver.tolerance * conditions.mean_radius;
  const auto gap_at = [&](const Particles& at, const Pair& pair) {
    return gap(at.placed_shape(index_of(pair.first)),
               at.placed_shape(index_of(pair.second), shift_of(at.cell, pair.image)));
  };
  for (const auto& pair : step.pairs) {
    const auto i = index_of(pair.first), j = index_of(pair.second);
    if (p.shape(i).sides() == 0 || p.shape(j).sides() == 0) continue;
    const double least = std::min(fluid.threshold_gap, gap_at(p, pair)) - allowed;
    if (const double left = gap_at(after, pair); left < least)
      throw Error(ErrorKind::kNotConverged,
                  "the {}s {} and {} would have a gap of {:.3g} after the step, less than "
                  "fluid.threshold_gap, {:.3g}, at a place that is no contact when the step "
                  "begins; a shorter time step helps",
                  p.shape(i).name(), p.id(i), p.id(j), left, fluid.threshold_gap);
  }
}

}  // namespace

std::vector<Contact<2>> contacts_of_stops(const Links& links, const Particles& particles) {
  std::vector<Contact<2>> contacts;
  for (const auto& stop : stop_equations(links, particles)) {
    const auto& part = stop.parts().front();
    const double lever = particles.radii[index_of(part.particle)];
    Contact<2> contact{-1, part.particle, {}, lever * stop.rows.front().value};
    contact.obstacle = -1;
    contact.levers = {0, lever * part.direction[2]};
    contacts.push_back(contact);
  }
  return contacts;
}

void add_torques_of_stops(const Links& links, const Particles& particles,
                          std::span<const Contact<2>> contacts, double h,
                          std::span<double> link_forces) {
  const auto stops = stop_equations(links, particles);
  assert(h > 0 && contacts.size() >= stops.size());
  const auto of_stops = contacts.last(stops.size());
  for (std::size_t s = 0; s < stops.size(); ++s)
    link_forces[stops[s].first_force] += of_stops[s].levers[1] * of_stops[s].impulse / h;
}

namespace {

/// False if a hinge holds the point of contact, so that its force cannot change the gap.
bool moves(const Contact<2>& contact, const Mobility& mobility,
           const ContactConditions& conditions) {
  if (!(conditions.least_w > 0)) return true;
  std::vector<double> forces(conditions.free_velocities.size());
  add_contact_force(contact, 1, forces, conditions.layout);
  return opening(contact, mobility(forces).data(), conditions.layout) > conditions.least_w;
}

/// Remembers the velocities for the forces of single contacts, for which problems with friction ask
/// repeatedly.
Mobility remembered(const Mobility& mobility) {
  return
      [&mobility, answers = std::make_shared<std::map<std::vector<double>, std::vector<double>>>()](
          std::span<const double> forces) {
        // The force of one contact has at most six components that are not 0: two forces and a
        // torque on each particle. Nothing asks twice for sums of more forces.
        constexpr std::ptrdiff_t kMost = 6;
        if (std::ranges::count_if(forces, [](double f) { return f != 0; }) > kMost)
          return mobility(forces);
        auto [place, is_new] = answers->try_emplace({forces.begin(), forces.end()});
        if (is_new) place->second = mobility(forces);
        return place->second;
      };
}

}  // namespace

void solve_listed(StepContacts& step, const Mobility& mobility,
                  const ContactConditions& conditions) {
  ContactProblem problem(conditions, mobility);
  Selection selection(step.contacts.size());
  const auto& chosen = selection.members();
  for (auto& contact : step.contacts) contact.w = 0;
  step.is_solved = true;
  for (;;) {
    const auto before = chosen.size();
    for (std::size_t c = 0; c < step.contacts.size(); ++c) {
      const auto& contact = step.contacts[c];
      const double after =
          gap_after(contact, problem.velocities().data(), conditions.h, conditions.layout);
      const bool takes_part = after < 0 || Selection::is_bound(contact.lowest, contact.impulse);
      if (selection.is_decided(c) || !takes_part) continue;
      if (!moves(contact, mobility, conditions)) {
        selection.leave_out(c);
        step.contacts[c].w = kImmovable;
        continue;
      }
      selection.join(c);
      problem.add(contact);
    }
    const bool has_joined = chosen.size() > before;
    if (!has_joined && !problem.is_rough()) break;
    step.is_solved =
        problem.solve(has_joined && problem.iterations() < conditions.solver.max_iterations);
  }
  for (auto& contact : step.contacts) contact.impulse = 0;
  for (std::size_t i = 0; i < chosen.size(); ++i) step.contacts[chosen[i]] = problem.contacts()[i];
  step.of_gaps.assign(step.contacts.size(), {});
  auto responses = problem.responses();
  for (std::size_t i = 0; i < responses.size(); ++i)
    step.of_gaps[chosen[i]] = std::move(responses[i]);
  step.amplification = problem.amplification();
  step.loads = problem.loads();
  step.velocities = problem.velocities();
  step.iterations += problem.iterations();
  step.stages += problem.stages();
}

double reach_of(const State& state, const Fluid& fluid, std::span<const double> velocities,
                const ContactConditions& conditions) {
  const auto& cell = state.particles.cell;
  const double of_images =
      norm(velocity_of_image(cell, Periods{1, 0})) + norm(velocity_of_image(cell, Periods{0, 1}));
  const auto& p = state.particles;
  double of_turns = 0;  // of the surfaces of particles that are not round [L/T]
  for (std::size_t k = 0; k < p.shapes.size(); ++k)
    if (!p.is_round(k)) of_turns = std::max(of_turns, p.radii[k] * std::abs(velocities[3 * k + 2]));
  return fluid.threshold_gap +
         conditions.h * (2 * (fastest(velocities, conditions.layout) + of_turns) + of_images);
}

StepContacts solve_contacts(const State& state, const Fluid& fluid, const Links& links,
                            std::span<const PlanePosition> obstacles,
                            const std::function<bool(const Pair&)>& is_left_out,
                            const Mobility& mobility, const ContactConditions& conditions,
                            ThreadPool& pool, const FrictionOfStep* friction) {
  assert(friction == nullptr || friction->setting.laws.friction);
  const auto& p = state.particles;
  const auto& free = conditions.free_velocities;
  const auto stops = contacts_of_stops(links, p);
  // The first reach is a guess, which is enlarged if it was too small. Contacts seldom push
  // particles to more than twice the largest speed without contact.
  double reach =
      std::max(conditions.least_reach, reach_of(state, fluid, free, conditions) +
                                           2 * conditions.h * fastest(free, conditions.layout) +
                                           1e-3 * conditions.mean_radius);
  const Mobility remembering = remembered(mobility);
  const double mu_s = friction != nullptr ? friction->setting.laws.friction->coefficient : 0;
  const auto solve = [&](StepContacts& step) {
    if (friction != nullptr)
      solve_with_friction(step, mu_s, remembering, conditions);
    else
      solve_listed(step, mobility, conditions);
    correct_impulses(step, mu_s, mobility, conditions);
  };
  int iterations = 0;
  contact_solver::StagesRun stages;
  for (;;) {
    StepContacts step;
    step.iterations = iterations;
    step.stages = stages;
    list_pairs(step, state, obstacles, reach, pool);
    std::erase_if(step.pairs, is_left_out);
    std::erase_if(step.walls, is_left_out);
    make_contacts(step, p, fluid, obstacles, conditions, friction);
    step.contacts.insert(step.contacts.end(), stops.begin(), stops.end());
    solve(step);
    for (int n = 0; n < FluidContactTuning::kMostCorrections && p.has_other_shapes(); ++n) {
      if (!correct_turns(step, p, fluid, obstacles, conditions)) break;
      solve(step);
      if (n + 1 == FluidContactTuning::kMostCorrections) step.is_solved = false;
    }
    step.reach = reach;
    const double needed = reach_of(state, fluid, step.velocities, conditions);
    if (needed <= reach) {
      check_turns(step, p, conditions);
      check_sides_apart(step, p, fluid, conditions);
      return step;
    }
    iterations = step.iterations;
    stages = step.stages;
    reach = 2 * needed;
  }
}

std::vector<double> set_allowed(std::span<Contact<2>> contacts,
                                const ContactConditions& conditions) {
  const auto& free = conditions.free_velocities;
  const auto& settings = conditions.solver;
  const auto& layout = conditions.layout;
  const double h = conditions.h;
  std::vector<double> of_particle(free.size() / layout.components, 0.0);
  const auto for_particles = [](const Contact<2>& contact, const auto& visit) {
    for (const auto k : {contact.first, contact.second})
      if (k >= 0) visit(index_of(k));
  };
  for (const auto& contact : contacts) {
    if (!(contact.w > 0)) continue;
    const double after = gap_after(contact, free.data(), h, layout);
    // If gamma < 0, the film also pulls, so that an impulse is needed to keep the gap from opening.
    const double stopping = (contact.lowest < 0 ? std::abs(after) : std::max(0.0, -after));
    const double impulse = std::max(std::abs(contact.impulse), stopping / contact.w);
    for_particles(contact,
                  [&](std::size_t k) { of_particle[k] = std::max(of_particle[k], impulse); });
  }
  const double rounding = rounding_error_of_gaps(conditions);
  std::vector<double> at_work(contacts.size(), std::numeric_limits<double>::infinity());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for_particles(contacts[c],
                  [&](std::size_t k) { at_work[c] = std::min(at_work[c], of_particle[k]); });
    auto& contact = contacts[c];
    contact.allowed = settings.tolerance * conditions.mean_radius / 2;
    if (contact.w > 0)
      contact.allowed = std::min(
          contact.allowed, std::max(settings.impulse_tolerance * contact.w * at_work[c], rounding));
  }
  return at_work;
}

StepResiduals measure_residuals(std::span<Contact<2>> contacts, std::span<const double> velocities,
                                const ContactConditions& conditions) {
  assert(velocities.size() == conditions.free_velocities.size());
  const auto at_work = set_allowed(contacts, conditions);
  StepResiduals residuals;
  residuals.impulse_errors.resize(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& contact = contacts[c];
    if (contact.w == kImmovable) continue;
    const double after = gap_after(contact, velocities.data(), conditions.h, conditions.layout);
    if (!contact.is_stop())
      residuals.take_gap(
          after, {contact.first >= 0 ? contact.first : -1 - contact.obstacle, contact.second});
    // A contact that was left out of the problem (w = 0) must not close.
    const bool takes_part = contact.w > 0;
    const double residual =
        takes_part ? contact_residual(after, contact.w * (contact.impulse - contact.lowest))
                   : std::max(0.0, -after);
    residuals.take(residual, contact.allowed);
    if (!takes_part) continue;
    residuals.impulse_errors[c] = residual / contact.w;
    residuals.take_impulse(residual / contact.w, at_work[c]);
  }
  return residuals;
}

}  // namespace viscontact::particles
