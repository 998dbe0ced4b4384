// Time stepping of particles in a fluid (fluid_simulation.hpp): velocities without contact, contact
// impulses, velocities with them, gamma, positions. Units are those of the case. Restarts must give
// the same bits, so a step may depend on nothing but the setting and the state.
#include "viscontact/particles/fluid/fluid_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/film.hpp"
#include "viscontact/particles/fluid/fluid_contacts.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"
#include "viscontact/particles/obstacles.hpp"

namespace viscontact::particles {
namespace {

using Clock = std::chrono::steady_clock;

double largest_of(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace

/// The velocities of a step, and what they come from.
struct FluidSimulation::Motion {
  std::vector<double> velocities;     ///< of the particles, with contact
  std::vector<FluidContact> contacts;  ///< of all pairs of the state, in their order
  ContactSolution solution;
  FluidStepReport fluid;
  FlowQuantities quantities;
  std::vector<double> reported;
};

FluidSimulation::FluidSimulation(Setting setting, State state,
                                 std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      layout_{motion_components(state_.particles.dimension)},
      mean_radius_(mean_radius(state_.particles)),
      pool_(1),
      obstacles_(obstacles_of(setting_)) {
  auto& p = state_.particles;
  p.cell = cell_of(setting_.domain);
  if (layout_.components == 3) {
    p.angles.resize(p.count());
    p.angular_velocities.resize(p.count());
  }
  wrap_into_cell(state_);
}

std::vector<double> FluidSimulation::external_forces(double from, double to) const {
  const auto& p = state_.particles;
  std::vector<double> forces(p.count() * layout_.components);
  for (std::size_t k = 0; k < p.count(); ++k)
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      forces[k * layout_.components + d] = p.masses[k] * setting_.gravity[d];
  for (const auto& [particle, force] : setting_.forces) {
    const Vector mean = force.mean(from, to);
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      forces[layout_.at(particle, d)] += mean[d];
  }
  if (layout_.components == 3)
    for (const auto& [particle, torque] : setting_.torques)
      forces[layout_.at(particle, 2)] += torque.mean(from, to)[2];
  return forces;
}

FluidParticles FluidSimulation::bodies(double h, double next, std::vector<double>& inertia) const {
  const auto& p = state_.particles;
  FluidParticles bodies{&p, p.angles, {}, {}};
  for (const auto& [particle, motion] : setting_.given_motions) {
    const Vector velocity = motion.velocity.mean(state_.time, next);
    std::array<double, 3> components{velocity[0], 0, 0};
    if (layout_.components == 3)
      components = {velocity[0], velocity[1], motion.angular_velocity.mean(state_.time, next)[2]};
    bodies.driven.emplace(particle, components);
  }
  inertia.assign(p.count() * layout_.components, 0);
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      inertia[k * layout_.components + d] = p.masses[k] / h;
    // A disc whose moment of inertia is not given is uniform.
    if (layout_.components == 3)
      inertia[k * 3 + 2] = (p.inertias.empty() ? p.masses[k] * p.radii[k] * p.radii[k] / 2
                                               : p.inertias[k]) /
                           h;
  }
  if (largest_of(inertia) > 0) bodies.inertia = inertia;
  return bodies;
}

/// Computes the velocities of a step of length h that ends at `next`.
FluidSimulation::Motion FluidSimulation::solve(double h, double next, bool is_estimated) {
  const auto begin = Clock::now();
  auto& p = state_.particles;
  Motion motion;
  std::vector<double> inertia;
  const auto placed = bodies(h, next, inertia);
  solver_->place(placed);
  auto forces = external_forces(state_.time, next);
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout_.directions(); ++d)
      forces[k * layout_.components + d] +=
          inertia[k * layout_.components + d] * p.velocities[k * layout_.directions() + d];
    if (layout_.components == 3) forces[k * 3 + 2] += inertia[k * 3 + 2] * p.angular_velocities[k];
  }
  motion.velocities = solver_->velocities(forces, true);
  const auto free_velocities = motion.velocities;

  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  const auto is_driven = [&](std::size_t i) {
    return placed.driven.contains(static_cast<std::int32_t>(i / layout_.components));
  };
  const Mobility mobility = [&](std::span<const double> loads) {
    if (!is_split) return solver_->velocities(loads, false);
    std::vector<double> velocities(loads.size());
    for (std::size_t i = 0; i < loads.size(); ++i)
      velocities[i] = is_driven(i) || inertia[i] == 0 ? 0 : loads[i] / inertia[i];
    return velocities;
  };
  const auto places = positions_of(obstacles_, next);
  const double threshold = setting_.fluid->threshold_gap;
  // Contacts push particles at speeds that are seldom above twice the largest one without contact.
  double reach = threshold + 4 * h * largest_of(free_velocities) + 1e-3 * mean_radius_;
  for (;;) {
    list_pairs_in_reach(state_, places, reach, pool_);
    motion.contacts.clear();
    std::vector<std::size_t> chosen;
    std::vector<char> is_chosen;
    const auto pairs = all_pairs(state_);
    for (const auto* pair : pairs)
      motion.contacts.push_back(fluid_contact_of(p, *pair, places, threshold));
    is_chosen.assign(pairs.size(), 0);
    // A threshold gap that is crossed by less than the tolerance counts as reached.
    for (auto& contact : motion.contacts)
      if (std::abs(contact.gap) <= setting_.solver.tolerance * mean_radius_) contact.gap = 0;
    std::vector<FluidContact> taking_part;
    motion.velocities = free_velocities;
    std::vector<double> loads(forces.size());
    for (bool grows = true; grows;) {
      grows = false;
      for (std::size_t c = 0; c < motion.contacts.size(); ++c) {
        const auto& contact = motion.contacts[c];
        const double after = contact.gap + h * opening(contact, motion.velocities, layout_);
        if (is_chosen[c] != 0 || !(after < 0 || contact.gamma < 0)) continue;
        is_chosen[c] = 1;
        chosen.push_back(c);
        grows = true;
      }
      if (!grows) break;
      taking_part.clear();
      for (const auto c : chosen) taking_part.push_back(motion.contacts[c]);
      const auto solved = solve_contact_problem(taking_part, free_velocities, h, mobility, layout_,
                                                setting_.solver, mean_radius_);
      motion.solution.iterations += solved.iterations;
      motion.solution.converged = solved.converged;
      std::ranges::fill(loads, 0.0);
      for (const auto& contact : taking_part)
        add_contact_force(contact, contact.impulse / h, loads, layout_);
      const auto added = mobility(loads);
      for (std::size_t i = 0; i < added.size(); ++i)
        motion.velocities[i] = free_velocities[i] + added[i];
    }
    for (auto& contact : motion.contacts) contact.impulse = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i) motion.contacts[chosen[i]] = taking_part[i];
    const double needed = threshold + 2 * h * largest_of(motion.velocities);
    if (needed <= reach) {
      if (!is_split)
        for (std::size_t i = 0; i < forces.size(); ++i) forces[i] += loads[i];
      break;
    }
    reach = 2 * needed;
  }
  // The flow, and the forces of the fluid, are those with the contact forces.
  if (!motion.contacts.empty() && !is_split) motion.velocities = solver_->velocities(forces, true);
  if (is_estimated) {
    const auto estimate = solver_->estimate(forces);
    motion.fluid.velocity_error = estimate.relative_error;
    motion.fluid.velocity_error_of_one_mesh = estimate.relative_error_of_one_mesh;
    if (!is_split) motion.reported = estimate.velocities;
  }
  motion.quantities = solver_->quantities();
  motion.fluid.dissipation = motion.quantities.dissipation;
  motion.fluid.apparent_viscosity = motion.quantities.apparent_viscosity;
  motion.fluid.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return motion;
}

/// Displacements of a step [L], rotations [rad]: h u, and for particles without inertia that are away from contact
/// and whose forces did not jump, the formula of Adams and Bashforth with the step before.
std::vector<double> FluidSimulation::displacements(const Motion& motion, double h) const {
  const auto& p = state_.particles;
  std::vector<double> moved(motion.velocities.size());
  for (std::size_t i = 0; i < moved.size(); ++i) moved[i] = h * motion.velocities[i];
  if (state_.earlier_velocities.size() != moved.size() || !(state_.earlier_step > 0)) return moved;
  const auto now = external_forces(state_.time, state_.time + h);
  const auto before = external_forces(std::max(0.0, state_.time - state_.earlier_step), state_.time);
  std::vector<char> is_smooth(p.count(), 1);
  for (std::size_t k = 0; k < p.count(); ++k) {
    if (p.masses[k] > 0 || setting_.given_motions.contains(static_cast<std::int32_t>(k)))
      is_smooth[k] = 0;
  }
  // The flow of one particle acts on all others, so that a jump of one force is one for all.
  constexpr double kSame = 1e-12;
  double jump = 0;
  for (std::size_t i = 0; i < now.size(); ++i) jump = std::max(jump, std::abs(now[i] - before[i]));
  bool has_contact = jump > kSame * largest_of(now);
  for (const auto* list : {&state_.pairs, &state_.walls})
    for (const auto& pair : *list) has_contact |= pair.impulse != 0;
  for (const auto& contact : motion.contacts) has_contact |= contact.impulse != 0;
  if (has_contact) return moved;
  const double share = h * h / (2 * state_.earlier_step);
  auto corrected = moved;
  for (std::size_t i = 0; i < moved.size(); ++i)
    if (is_smooth[i / layout_.components] != 0)
      corrected[i] += share * (motion.velocities[i] - state_.earlier_velocities[i]);
  for (const auto& contact : motion.contacts)
    if (contact.gap + opening(contact, corrected, layout_) < 0) return moved;
  return corrected;
}

void FluidSimulation::move(const Motion& motion, double h, double next, StepReport& report) {
  auto& p = state_.particles;
  const auto moved = displacements(motion, h);
  const auto radius = [&](std::int32_t k) {
    return k < 0 ? std::numeric_limits<double>::infinity() : p.radii[index_of(k)];
  };
  const auto pairs = all_pairs(state_);
  for (std::size_t c = 0; c < pairs.size(); ++c) {
    const auto& contact = motion.contacts[c];
    auto& pair = *pairs[c];
    pair.impulse = contact.impulse;
    const double error = contact.w > 0 ? contact.residual / contact.w : 0;
    if (contact.w > 0)
      absorb_impulse(pair, error,
                     setting_.law.lower_bound(radius(pair.second), radius(pair.first)));
    if (pair.gamma < 0) ++report.glued;
    if (contact.w > 0) ++report.contacts;
    report.residual = std::max(report.residual, contact.residual / mean_radius_);
    const double gap = contact.gap + h * opening(contact, motion.velocities, layout_);
    report.largest_overlap = std::max(report.largest_overlap, -gap / mean_radius_);
  }
  for (std::size_t k = 0; k < p.count(); ++k) {
    for (std::size_t d = 0; d < layout_.directions(); ++d) {
      p.positions[k * layout_.directions() + d] += moved[k * layout_.components + d];
      p.velocities[k * layout_.directions() + d] = motion.velocities[k * layout_.components + d];
    }
    if (layout_.components == 3) {
      p.angles[k] += moved[k * 3 + 2];
      p.angular_velocities[k] = motion.velocities[k * 3 + 2];
    }
  }
  state_.earlier_velocities = motion.velocities;
  state_.earlier_step = h;
  state_.time = next;
  wrap_into_cell(state_);
}

StepReport FluidSimulation::step(double end) {
  double h = setting_.time_step;
  const double tiny = 1e-6 * h;
  if (!(end > state_.time + tiny)) return {.time = state_.time, .parts = 1};
  double next = state_.grid_time + static_cast<double>(state_.steps + 1 - state_.grid_step) * h;
  const bool is_cut = next > end + tiny;
  if (is_cut) {
    next = end;
    h = end - state_.time;
  }
  StepReport report{.time = next};
  const auto motion = solve(h, next, state_.steps == 0 || next >= end - tiny);
  report.iterations = motion.solution.iterations;
  report.converged = motion.solution.converged;
  report.fluid = motion.fluid;
  report.parts = 1;
  const double largest = largest_resolved_distance(setting_.solver.tolerance, mean_radius_);
  if (!(h * largest_of(motion.velocities) < largest))
    throw Error(ErrorKind::kNotConverged,
                fmt::format("a particle moves by {} in the step to time {}, too far for the "
                            "precision of a double; check the forces and the time step",
                            h * largest_of(motion.velocities), next));
  move(motion, h, next, report);
  quantities_ = motion.quantities;
  reported_ = motion.reported;
  ++state_.steps;
  if (is_cut) {
    state_.grid_time = next;
    state_.grid_step = state_.steps;
  }
  return report;
}

FlowField FluidSimulation::flow_at_present() {
  // The problem lists the pairs of particles anew, which must not change the state.
  const auto before = state_;
  const double h = setting_.time_step;
  try {
    solve(h, state_.time + h, false);
  } catch (...) {
    state_ = before;
    throw;
  }
  state_ = before;
  return solver_->flow();
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
