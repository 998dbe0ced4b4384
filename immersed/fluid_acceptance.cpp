// Examines a step in a fluid and changes the state by it.

#include <algorithm>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/immersed/contacts/closed_contacts.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/immersed/fluid_motion.hpp"
#include "viscontact/immersed/links/constrained_motion.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"

namespace viscontact::particles {

StepResiduals FluidSimulation::residuals_of(StepContacts& contact,
                                            std::span<const double> velocities,
                                            const ContactConditions& conditions) const {
  auto residuals = measure_residuals(contact.contacts, velocities, conditions);
  if (setting_.laws.friction)
    take_residuals_of_friction(contact, setting_.laws.friction->coefficient, velocities, conditions,
                               residuals);
  take_errors_of_impulses(contact, setting_.laws.friction ? setting_.laws.friction->coefficient : 0,
                          velocities, conditions, residuals);
  return residuals;
}

void FluidSimulation::examine(Motion& motion, double h, StepReport& report) const {
  const double largest = largest_resolved_distance(setting_.solver.tolerance, mean_radius_);
  const double longest = h * fastest(motion.moved, layout_);
  if (!(longest < largest))
    throw Error(ErrorKind::kNotConverged,
                "a particle moves by {} in the step to time {}, too far for the precision of a "
                "double; check the forces and the time step",
                longest, report.time);
  const auto& impact = motion.impact;
  // In a step with an impact the impulses of motion.contact do not cause the displacements.
  // Therefore only the gaps of these contacts are examined.
  if (impact)
    for (auto& contact : motion.contact.contacts) contact.w = std::min(contact.w, 0.0);
  const auto conditions = contact_conditions(motion.free, h);
  auto residuals = residuals_of(motion.contact, motion.moved, conditions);
  refuse_deep_overlap(residuals, state_.particles, setting_, mean_radius_, report.time, [] {
    return "is the time step too long for the forces, or do particles with given motions leave the "
           "others too little room?";
  });
  report.has_given_loads = motion.contact.has_given_loads;
  report.converged =
      motion.contact.is_solved && motion.links_hold && (!impact || impact->is_solved);
  if (!motion.links_hold || (impact && !impact->is_solved))
    report.excess = std::numeric_limits<double>::infinity();
  report_residuals(residuals, mean_radius_, report);
  if (impact) {
    StepContacts of_impact;
    of_impact.contacts = impact->contacts;
    of_impact.of_gaps = impact->of_gaps;
    of_impact.amplification = impact->amplification;
    const auto of_impulse_time = contact_conditions(motion.free, impulse_time_of(h));
    residuals = measure_residuals(of_impact.contacts, motion.after, of_impulse_time);
    take_errors_of_impulses(of_impact, 0, motion.after, of_impulse_time, residuals);
    report_residuals(residuals, mean_radius_, report);
  }
  motion.impulse_errors = std::move(residuals.impulse_errors);
}

void FluidSimulation::remember_friction(const StepContacts& step, double share) {
  // The friction of a contact that slides is set to its bound, from which the solution differs by
  // its residual.
  const auto pairs = state_.pairs.size();
  for (auto* list : {&state_.pairs, &state_.walls})
    for (auto& pair : *list) {
      auto memory = state_.memories.of(pair.memory);
      memory.set_friction({});
      memory[Remembered::kSolidLoad] = 0;
      state_.memories.set(pair.memory, memory);
    }
  for (const auto& friction : step.frictions) {
    const auto& contact = step.contacts[friction.contact];
    if (!(contact.w > 0)) continue;
    auto& pair = friction.contact < pairs ? state_.pairs[friction.contact]
                                          : state_.walls[friction.contact - pairs];
    const double solid_load = share * friction.solid_load(contact);
    double impulse = share * friction.impulse;
    if (step.is_solved && friction.slides != 0)
      impulse = friction.slides * setting_.laws.friction->coefficient * solid_load;
    auto memory = state_.memories.of(pair.memory);
    memory.set_friction({impulse * friction.tangent[0], impulse * friction.tangent[1], 0});
    memory[Remembered::kSolidLoad] = solid_load;
    state_.memories.set(pair.memory, memory);
  }
}

void FluidSimulation::accept(Motion motion, double h, double next, StepReport& report) {
  // The flow of the first step is not kept, because the next step computes it again.
  const bool keeps_flow = setting_.fluid->has_inertia() && state_.earlier_step > 0;
  if (keeps_flow) solver_->keep_flow(false, motion.kept);
  auto& p = state_.particles;
  state_.pairs = std::move(motion.contact.pairs);
  state_.walls = std::move(motion.contact.walls);
  // In a fluid with inertia the second step of a run computes the forces of the first step again.
  // Only those of the second computation count.
  const bool counts = !is_computed_twice();
  std::size_t c = 0;
  for (auto* pairs : {&state_.pairs, &state_.walls})
    for (auto& pair : *pairs) {
      const auto& contact = motion.impact ? motion.impact->contacts[c] : motion.contact.contacts[c];
      const double share = motion.impact ? 1 : impulse_time_of(h) / h;
      if (contact.w > 0) ++report.contacts;
      if (contact.w > 0 && counts) {
        pair.impulse = motion.impact ? motion.impact->absorbed[c] : share * contact.impulse;
        setting_.laws.remember(pair, state_.memories, motion.contact.circles[c].radii,
                               share * motion.impulse_errors[c], h);
      }
      pair.impulse = counts ? share * contact.impulse : 0;
      if (pair.gamma < 0) ++report.glued;
      ++c;
    }
  if (setting_.laws.friction)
    remember_friction(motion.contact, counts ? impulse_time_of(h) / h : 0);
  state_.memories.keep_only(state_.pairs, state_.walls);
  rebounds_ = motion.impact ? std::move(motion.impact->rebounds) : std::vector<Rebound>{};
  move_bodies(motion, h, next);
  const auto n = layout_.directions();
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < n; ++d) {
      p.positions[k * n + d] += h * motion.moved[k * layout_.components + d];
      p.velocities[k * n + d] = motion.at_end[k * layout_.components + d];
    }
    if (layout_.components == 3) {
      p.angles[k] += h * motion.moved[k * 3 + 2];
      p.angular_velocities[k] = motion.at_end[k * 3 + 2];
    }
  }
  p.cell.moved_for = next;
  place_members(p);
  if (!counts) {
    std::ranges::fill(motion.link_forces, 0);
    std::ranges::fill(motion.arm_powers, 0);
  }
  state_.link_forces = std::move(motion.link_forces);
  state_.arm_powers = std::move(motion.arm_powers);
  if (!setting_.fluid->has_inertia())
    state_.earlier_velocities = std::move(motion.flow);
  else if (keeps_flow)
    state_.earlier_velocities = std::move(motion.kept);
  state_.earlier_forces = std::move(motion.drag);
  state_.step_before = state_.earlier_step;
  state_.earlier_step = h;
  state_.time = next;
  wrap_into_cell(state_);
  quantities_ = std::move(motion.quantities);
  force_errors_ = std::move(motion.force_errors);
  reported_ = std::move(motion.reported);
}

void FluidSimulation::move_bodies(const Motion& motion, double h, double next) {
  auto& p = state_.particles;
  if (p.bodies.empty()) return;
  const ConstrainedMotion constrained(setting_.links, p, LinkTimes{h, h, next});
  for (std::size_t b = 0; b < p.bodies.count(); ++b) {
    auto& body = p.bodies.bodies[b];
    const auto moved = constrained.motion_of_body(b, motion.linear);
    const auto at_end = constrained.motion_of_body(b, motion.at_end);
    body.centre = body.centre + h * moved.displacement;
    body.angle = body.angle + h * moved.turn;
    body.velocity = at_end.displacement;
    body.angular_velocity = at_end.turn;
    body.angular_momentum = body.inertia[8] * at_end.turn;
  }
}

Particles FluidSimulation::reported_particles() const {
  auto p = state_.particles;
  if (reported_.empty()) return p;
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      p.velocities[k * layout_.directions() + d] = reported_[k * layout_.components + d];
    if (layout_.components == 3) p.angular_velocities[k] = reported_[k * 3 + 2];
  }
  return p;
}

}  // namespace viscontact::particles
