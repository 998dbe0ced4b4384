// A step in a fluid, (6.1) to (6.5) in docs/physics.md: velocities without contact, contacts, and
// velocities with them.
#include "viscontact/immersed/fluid_simulation.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <functional>

#include "viscontact/common/error.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/immersed/fluid/fluid_solver.hpp"
#include "viscontact/immersed/fluid_motion.hpp"
#include "viscontact/immersed/links/constrained_motion.hpp"
#include "viscontact/immersed/links/constrained_solver.hpp"
#include "viscontact/immersed/step_equation.hpp"
#include "viscontact/particles/domain/domain.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/steps/step_times.hpp"

namespace viscontact::particles {
namespace {

using Clock = std::chrono::steady_clock;

/// Free choices of a step.
struct FluidStepTuning {
  // How often a step is solved with geometric rows at most. Tensions hardly depend on how fast
  // links turn.
  static constexpr int kMostTurns = 10;
  // A particle resists a force with its mass over the step plus a drag of about the viscosity, or
  // some 1e5 times the viscosity in the narrowest gap that a mesh resolves. Over 1/(viscosity +
  // mass over the step), least_w is therefore kShareOfW, or kAboveErrors times the relative error
  // of velocities if this is more.
  static constexpr double kShareOfW = 1e-9, kAboveErrors = 10;
};

LinkTimes times_of_links(const StepEquation& equation, double h, double next) {
  const auto flow = equation.flow_step();
  return {h, h, next, false, flow.from, flow.to};
}

}  // namespace

FluidSimulation::FluidSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      layout_{motion_components(state_.particles.dimension)},
      mean_radius_(mean_radius(state_.particles)),
      pool_(1),
      obstacles_(obstacles_of(setting_)) {
  assert(setting_.fluid && solver_ != nullptr);
  auto& p = state_.particles;
  // A restart file of a run without a fluid has no velocities of the step before, and may contain
  // collisions, which a step in a fluid does not use.
  if (state_.earlier_velocities.empty()) state_.earlier_step = 0;
  state_.impact_impulses = {};
  auto& film = setting_.laws.film;
  film.shape = p.dimension == 1 ? FilmShape::kSpheres : FilmShape::kDiscs;
  film.begins_at = setting_.fluid->threshold_gap;
  p.cell = cell_of(setting_);
  p.cell.moved_for = state_.time;
  if (layout_.components == 3) {
    p.angles.resize(p.count());
    p.angular_velocities.resize(p.count());
  }
  wrap_into_cell(state_);
  if (setting_.fluid->has_inertia() && state_.steps > 0) {
    if (state_.flow.empty())
      throw Error(ErrorKind::kBadInput,
                  "the restart file has no flow, because its run had a fluid without inertia; a "
                  "case with fluid.density > 0 can continue runs of such cases only");
    solver_->load_flow(std::string(state_.flow.begin(), state_.flow.end()));
    has_flow_ = true;
  }
  state_.flow.clear();
  has_links_ = !setting_.links.empty() || !p.bodies.empty();
  if (!has_links_ && layout_.components != 3) return;
  auto constrained = std::make_unique<ConstrainedSolver>(
      std::move(solver_), error_of_answers(*setting_.fluid), setting_.fluid->has_inertia());
  constrained_solver_ = constrained.get();
  solver_ = std::move(constrained);
}

State FluidSimulation::state_to_save() {
  auto state = state_;
  if (has_flow_) {
    const auto flow = solver_->saved_flow();
    state.flow.assign(flow.begin(), flow.end());
  }
  return state;
}

void FluidSimulation::begin_flow(double h) {
  if (!setting_.fluid->has_inertia() || has_flow_) return;
  const StepEquation equation(setting_, state_, h, state_.time + h);
  auto bodies = equation.bodies();
  bodies.flow_step.order = 0;
  bodies.flow_step.time = state_.time;
  if (constrained_solver_ != nullptr) {
    const ConstrainedMotion constrained(setting_.links, state_.particles,
                                        times_of_links(equation, h, state_.time + h),
                                        equation.link_times());
    constrained_solver_->hold(constrained.rows(), h);
  }
  solver_->place(bodies);
  const bool at_rest = setting_.fluid->start == FlowStart::kRest;
  if (at_rest) {
    state_.earlier_velocities = equation.velocities();
  } else {
    state_.earlier_velocities = solver_->velocities(equation.right_side(), true);
    first_kinetic_energy_ = solver_->quantities().kinetic_energy;
  }
  solver_->keep_flow(at_rest, state_.earlier_velocities);
  has_flow_ = true;
}

std::vector<double> FluidSimulation::free_velocities(const StepEquation& equation,
                                                     std::span<const double> flow, double h,
                                                     const ConstrainedMotion* constrained) {
  assert(flow.size() == state_.particles.count() * layout_.components);
  std::vector<double> free(flow.begin(), flow.end());
  if (setting_.fluid->has_inertia()) {
    for (std::size_t i = 0; i < free.size(); ++i) {
      const auto k = static_cast<std::int32_t>(i / layout_.components);
      if (equation.is_driven(k))
        free[i] = equation.given_in_step(k)[i % layout_.components];
      else if (!equation.is_in_contact(k))
        free[i] += equation.share_of_change() * (flow[i] - state_.earlier_velocities[i]);
    }
    return free;
  }
  auto earlier = state_.earlier_velocities;
  if (earlier.size() != free.size() || state_.earlier_forces.size() != free.size() ||
      !(state_.earlier_step > 0) || !equation.drives_as_before())
    return free;
  auto now = equation.right_side();
  if (constrained != nullptr) {
    // Bodies have turned since the step before. The velocities of their members in that step are
    // replaced by those that the same rigid motion has at the present places of the members.
    constrained->make_rigid(earlier);
    add_elements(constrained_solver_->forces_of_step(), now);
  }
  std::vector<double> difference(free.size());
  for (std::size_t i = 0; i < free.size(); ++i)
    difference[i] = state_.earlier_forces[i] + equation.inertia()[i] * earlier[i] - now[i];
  std::vector<double> changed(flow.begin(), flow.end());
  if (largest_magnitude(difference) > 0) {
    const auto added = constrained_solver_ != nullptr
                           ? constrained_solver_->velocities_without_springs(difference)
                           : solver_->velocities(difference, false);
    for (std::size_t i = 0; i < changed.size(); ++i) changed[i] += added[i];
  }
  // Links have turned since the step before. The earlier velocities are changed until the links
  // hold with their present directions, so that the difference that is extrapolated comes from the
  // resistance of the fluid alone.
  if (constrained_solver_ != nullptr) constrained_solver_->hold_velocities(earlier);
  const double share = h / (2 * state_.earlier_step);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto k = static_cast<std::int32_t>(i / layout_.components);
    if (!equation.is_in_contact(k) && !equation.is_driven(k))
      free[i] += share * (changed[i] - earlier[i]);
  }
  return free;
}

ContactConditions FluidSimulation::contact_conditions(std::span<const double> free,
                                                      double h) const {
  assert(h > 0);
  const auto& fluid = *setting_.fluid;
  ContactConditions conditions{free,
                               h,
                               layout_,
                               setting_.solver,
                               mean_radius_,
                               error_of_answers(fluid),
                               impulse_time_of(h) / h};
  conditions.is_symmetric = !fluid.has_inertia() || fluid.coupling == Coupling::kSplitting;
  if (!setting_.links.hinges.empty()) {
    // If a hinge holds a gap, the change w of the velocity of this gap by a unit force [T/M] should
    // be 0, but consists of errors. least_w must lie between these errors and the least w of a gap
    // that can change. There are no hinges on an axis, where the drag would have another dimension.
    double heaviest = 0;
    const auto& p = state_.particles;
    for (std::size_t k = 0; k < p.count(); ++k)
      heaviest = std::max(heaviest, p.masses[k] + fluid.density * fluid.size_of(p.shape(k), k));
    for (const auto& body : p.bodies.bodies) heaviest = std::max(heaviest, body.mass);
    conditions.least_w = std::max(FluidStepTuning::kShareOfW,
                                  FluidStepTuning::kAboveErrors * error_of_answers(fluid)) /
                         (fluid.viscosity + heaviest / impulse_time_of(h));
  }
  return conditions;
}

double FluidSimulation::impulse_time_of(double h) const {
  // In a fluid with inertia forces change the velocities in the step that ends at the present
  // places, and particles move with them in the step that begins there.
  const auto& fluid = *setting_.fluid;
  const bool is_of_flow = fluid.has_inertia() && fluid.coupling != Coupling::kSplitting;
  return is_of_flow && state_.earlier_step > 0 ? state_.earlier_step : h;
}

bool FluidSimulation::is_computed_twice() const {
  return setting_.fluid->has_inertia() && !(state_.earlier_step > 0);
}

std::optional<FluidImpact> FluidSimulation::solve_contacts_of(const StepEquation& equation,
                                                              std::span<const double> free,
                                                              double h, double next,
                                                              StepContacts& contacts) {
  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  const auto inertia = equation.inertia_of_projection();
  const auto is_movable = [&](std::int32_t k) {
    return k >= 0 && !equation.is_driven(k) && !(is_split && inertia[layout_.at(k, 0)] == 0);
  };
  // With splitting the velocities come from the masses alone, otherwise from the fluid.
  const Mobility mobility = [&](std::span<const double> loads) {
    if (!is_split) return solver_->velocities(loads, false);
    std::vector<double> velocities(loads.size());
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (is_movable(static_cast<std::int32_t>(i / layout_.components)) && inertia[i] > 0)
        velocities[i] = loads[i] / inertia[i];
    return velocities;
  };
  const auto& fluid = *setting_.fluid;
  // Two kinds of pairs have no contact: those of which no particle can be moved, and the two ends
  // of an arm, which prescribes their distance.
  const auto is_left_out = [&](const Pair& pair) {
    return (!is_movable(pair.first) && !is_movable(pair.second)) ||
           std::ranges::any_of(setting_.links.arms, [&](const Arm& arm) {
             return std::minmax(arm.first, arm.second) == std::minmax(pair.first, pair.second);
           });
  };
  auto conditions = contact_conditions(free, h);
  const FrictionOfStep friction{setting_, obstacles_, state_.memories, state_.time, next};
  const bool has_inertia = fluid.has_inertia();
  const auto before = has_inertia ? state_.earlier_velocities : equation.velocities();
  // FluidImpactStep::loaded
  const auto loaded = [&] {
    if (has_inertia) return solver_->velocities(equation.forces(), false);
    std::vector<double> momentum(before.size());
    for (std::size_t i = 0; i < before.size(); ++i) momentum[i] = equation.inertia()[i] * before[i];
    auto velocities = solver_->velocities(momentum, false);
    for (std::size_t i = 0; i < before.size(); ++i) velocities[i] = free[i] - velocities[i];
    return velocities;
  };
  for (;;) {
    contacts = solve_contacts(
        state_, fluid, setting_.links, positions_of(obstacles_, next), is_left_out, mobility,
        conditions, pool_,
        setting_.laws.friction && setting_.laws.friction->coefficient > 0 ? &friction : nullptr);
    if (!setting_.laws.restitution.is_on() || is_computed_twice()) return std::nullopt;
    const FluidImpactStep step{setting_,           state_, obstacles_, next,
                               impulse_time_of(h), before, loaded};
    auto impact = solve_impact(contacts, step, mobility, conditions);
    if (!impact) return impact;
    // Solids may rebound faster than particles move without contact. If they could then reach
    // particles that are not listed, the step is solved again with a list up to a larger gap.
    const double needed = reach_of(state_, fluid, impact->velocities, conditions);
    if (needed <= contacts.reach) return impact;
    conditions.least_reach = 2 * needed;
  }
}

void FluidSimulation::keep_and_extrapolate(const StepEquation& equation, Motion& motion) const {
  // With coupling = splitting, contacts change the velocities of the particles, but not the flow.
  motion.kept = motion.flow;
  if (setting_.fluid->coupling == Coupling::kSplitting)
    for (std::size_t i = 0; i < motion.kept.size(); ++i)
      motion.kept[i] += motion.after[i] - motion.free[i];
  // The change in the first step is not extrapolated, because velocities may jump at the start.
  const double share = state_.steps > 1 ? 2 * equation.share_of_change() : 0;
  motion.at_end = motion.kept;
  for (std::size_t i = 0; i < motion.at_end.size(); ++i) {
    const auto k = static_cast<std::int32_t>(i / layout_.components);
    if (equation.is_driven(k))
      motion.at_end[i] = motion.moved[i];
    else if (!equation.is_in_contact(k))
      motion.at_end[i] += share * (motion.kept[i] - state_.earlier_velocities[i]);
  }
}

FluidSimulation::Motion FluidSimulation::solve(double h, double next, bool is_estimated) {
  const auto begin = Clock::now();
  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  Motion motion;
  StepEquation equation(setting_, state_, h, next);
  std::vector<double> forces;
  std::optional<ConstrainedMotion> constrained;
  std::vector<double> further_row_forces;  // the result of hold_after_step()
  std::vector<double> settled;             // of follow_turns()
  // A contact with an impulse sets theta = 1 for its particles, which changes the equation of
  // motion. The step is then solved again.
  StagesRun stages;
  for (int iterations = 0;;) {
    if (constrained_solver_ != nullptr) {
      constrained.emplace(setting_.links, state_.particles, times_of_links(equation, h, next),
                          equation.link_times());
      constrained_solver_->hold(constrained->rows(), h);
    }
    solver_->place(equation.bodies());
    forces = equation.right_side();
    auto loaded =
        forces;  // by contacts, those of the step before until those of this step are known
    const auto contacts = constrained ? contacts_before(h) : std::vector<Contact<2>>{};
    for (const auto& contact : contacts)
      add_contact_force(contact, contact.impulse / h, loaded, layout_);
    if (constrained)
      follow_turns(equation, *constrained, loaded, contacts,
                   constrained->row_forces(state_.link_forces), settled);
    for (int turns = 0;; ++turns) {
      motion.flow = solver_->velocities(forces, true);
      // Forces may have jumped since the step before.
      if (constrained && turns == 0 &&
          follow_turns(equation, *constrained, loaded, contacts, constrained_solver_->row_forces(),
                       settled))
        continue;
      motion.free =
          free_velocities(equation, motion.flow, h, constrained ? &*constrained : nullptr);
      motion.linear = motion.free;
      if (constrained) {
        further_row_forces = hold_after_step(equation, *constrained, motion.flow, motion.linear, h,
                                             motion.links_hold);
        motion.free = constrained->with_finite_turns(motion.linear);
      }
      motion.impact = solve_contacts_of(equation, motion.free, h, next, motion.contact);
      if (constrained)
        hold_with_contacts(equation, *constrained, h, next, motion, further_row_forces);
      iterations += motion.contact.iterations + (motion.impact ? motion.impact->iterations : 0);
      stages += motion.contact.stages;
      if (motion.impact) stages += motion.impact->stages;
      if (!constrained || motion.impact || turns == FluidStepTuning::kMostTurns) break;
      loaded = forces;
      auto of_rows = constrained_solver_->row_forces();
      if (largest_magnitude(motion.contact.loads) > 0) {
        add_elements(motion.contact.loads, loaded);
        of_rows = constrained_solver_->row_forces_under(loaded);
      }
      if (!follow_turns(equation, *constrained, loaded, motion.contact.contacts, of_rows, settled))
        break;
    }
    motion.contact.iterations = iterations;
    motion.contact.stages = stages;
    if (!equation.put_in_contact(motion.impact ? motion.impact->contacts : motion.contact.contacts))
      break;
  }
  motion.buckling = std::max(constrained ? constrained->pushing() : 0,
                             turn_of_films(motion.contact, equation) / 2);
  const auto& loads = motion.impact ? motion.impact->loads : motion.contact.loads;
  motion.after = motion.impact ? motion.impact->velocities : motion.contact.velocities;
  if (largest_magnitude(loads) > 0 && !is_split) {
    // The fluid is solved again with the contact forces, because the reported flow and forces of
    // the fluid contain their effect.
    const auto before = motion.flow;
    add_elements(loads, forces);
    motion.flow = solver_->velocities(forces, true);
    for (std::size_t i = 0; i < before.size(); ++i)
      motion.after[i] = motion.free[i] + (motion.flow[i] - before[i]);
  }
  motion.moved = motion.impact ? motion.impact->moved : motion.after;
  for (std::size_t i = 0; i < motion.moved.size(); ++i)
    motion.linear[i] += motion.moved[i] - motion.free[i];
  if (!motion.impact) motion.after = motion.linear;
  // The part of the forces that accelerates a particle does not act on the fluid.
  motion.drag = forces;
  for (std::size_t i = 0; i < forces.size(); ++i)
    motion.drag[i] -= equation.inertia()[i] * motion.flow[i];
  if (constrained) add_elements(constrained_solver_->forces_of_step(), motion.drag);
  motion.at_end = equation.velocities_at_end(motion.after, motion.flow);
  if (setting_.fluid->has_inertia()) keep_and_extrapolate(equation, motion);
  std::vector<double> of_step, at_end;  // the forces of the links within the step and at its end
  std::vector<double> row_forces;
  if (constrained) {
    row_forces = constrained_solver_->row_forces();
    if (!equation.link_times().empty()) add_elements(further_row_forces, row_forces);
    of_step = motion.link_forces = constrained->link_forces(row_forces);
    add_torques_of_stops(setting_.links, state_.particles,
                         motion.impact ? motion.impact->contacts : motion.contact.contacts, h,
                         motion.link_forces);
    if (!equation.link_times().empty()) {
      at_end = constrained->link_forces(
          hold_at_end(equation, *constrained, motion.linear, motion.at_end));
      add_elements(at_end, motion.link_forces);
    }
  }
  motion.quantities = solver_->quantities();
  auto drag = motion.quantities.fluid_forces;
  for (auto& force : drag) force = -force;
  if (constrained)
    constrained->keep_torques(motion.linear, drag, constrained_solver_->stiffnesses(), motion.drag);
  if (constrained && !setting_.links.arms.empty()) {
    const auto working = equation.velocities_of_work(motion.flow, motion.at_end, drag);
    for (std::size_t k = 0; k < setting_.links.arms.size(); ++k) {
      const auto place = setting_.links.place_of_arm(k, state_.particles.dimension);
      double power = of_step[place] * constrained->rate_of_arm(k, working) +
                     constrained->power_of_turning(k, row_forces, working);
      if (!at_end.empty())
        power += at_end[place] * constrained->rate_of_arm_at_end(k, motion.linear, working);
      motion.arm_powers.push_back(power);
    }
  }
  if (is_estimated && !setting_.fluid->has_inertia())
    estimate(equation, forces, constrained ? &*constrained : nullptr, motion);
  motion.fluid.flow_time = state_.time;
  motion.fluid.is_computed_again = is_computed_twice();
  if (motion.fluid.is_computed_again) {
    motion.fluid.kinetic_energy = first_kinetic_energy_;
  } else {
    motion.fluid.probes = motion.quantities.probes;
    motion.fluid.dissipation = motion.quantities.dissipation;
    motion.fluid.apparent_viscosity = motion.quantities.apparent_viscosity;
    motion.fluid.kinetic_energy = motion.quantities.kinetic_energy;
  }
  if (setting_.laws.friction && motion.fluid.dissipation > 0)
    motion.fluid.apparent_viscosity *=
        1 + heat_of_friction(motion.contact, motion.moved, contact_conditions(motion.free, h)) /
                motion.fluid.dissipation;
  if (setting_.fluid->has_inertia()) report_inertia(motion);
  motion.fluid.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return motion;
}

void FluidSimulation::report_inertia(Motion& motion) const {
  const auto& fluid = *setting_.fluid;
  const auto& p = state_.particles;
  auto& report = motion.fluid;
  report.courant_number = motion.quantities.courant_number;
  report.advection_error = motion.quantities.advection_error;
  for (std::size_t k = 0; k < p.count(); ++k) {
    double square = 0;
    for (std::size_t d = 0; d < layout_.directions(); ++d) {
      const auto i = k * layout_.components + d;
      square += motion.kept[i] * motion.kept[i];
      if (!report.is_computed_again &&
          setting_.given_motions.contains(static_cast<std::int32_t>(k)))
        report.given_force[d] += motion.quantities.fluid_forces[i];
    }
    report.reynolds_number = std::max(report.reynolds_number, fluid.density * std::sqrt(square) *
                                                                  2 * p.radii[k] / fluid.viscosity);
  }
}

void FluidSimulation::estimate(const StepEquation& equation, std::span<const double> forces,
                               const ConstrainedMotion* constrained, Motion& motion) {
  std::function<std::vector<double>()> link_forces;
  if (has_links_)
    link_forces = [&] { return constrained->link_forces(constrained_solver_->row_forces()); };
  auto estimate = estimate_flow(*solver_, forces, state_.particles, *setting_.fluid, link_forces);
  motion.fluid.velocity_errors = estimate.of_velocities;
  motion.fluid.force_errors = estimate.of_forces;
  motion.force_errors = {std::move(estimate.force_errors), std::move(estimate.further_errors)};
  motion.quantities = std::move(estimate.quantities);
  if (setting_.fluid->coupling == Coupling::kSplitting) return;
  auto moved = motion.after;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] += estimate.velocities[i] - motion.flow[i];
  motion.reported = equation.velocities_at_end(moved, estimate.velocities);
  if (constrained != nullptr && !equation.link_times().empty())
    hold_at_end(equation, *constrained, moved, motion.reported);
}

StepReport FluidSimulation::step(double end) {
  const auto interval = StepGrid(setting_.time_step).next(state_, end);
  if (!interval) return {.time = state_.time};
  StepReport report{.time = interval->end};
  begin_flow(interval->h);
  auto motion = solve(interval->h, interval->end, state_.steps == 0 || interval->reaches_end);
  report.iterations = motion.contact.iterations;
  report.solver_stages = text_of(motion.contact.stages);
  report.buckling = motion.buckling;
  report.fluid = motion.fluid;
  report.parts = 1;
  examine(motion, interval->h, report);
  accept(std::move(motion), interval->h, interval->end, report);
  StepGrid::count(state_, *interval);
  return report;
}

FlowField FluidSimulation::flow_at_present() {
  const double h = setting_.time_step;
  begin_flow(h);
  solve(h, state_.time + h, false);
  return solver_->flow();
}

}  // namespace viscontact::particles
