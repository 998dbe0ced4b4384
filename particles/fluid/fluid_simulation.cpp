// Time stepping of particles in a fluid (fluid_simulation.hpp): velocities without contact, contact
// impulses, velocities with them, gamma, positions. Units are those of the case. Restarts must give
// the same bits, so a step may depend on nothing but the setting and the state.
#include "viscontact/particles/fluid/fluid_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"
#include "viscontact/particles/contact/film.hpp"
#include "viscontact/particles/domain/obstacles.hpp"
#include "viscontact/particles/fluid/contact/contact_residuals.hpp"
#include "viscontact/particles/fluid/contact/step_contacts.hpp"
#include "viscontact/particles/fluid/step_equation.hpp"
#include "viscontact/particles/neighbours/neighbour_list.hpp"

namespace viscontact::particles {
namespace {

using Clock = std::chrono::steady_clock;

/// Relative rounding error of the velocities that a fluid solver answers. With a penalty they are
/// rounded like numbers 1/(eps mu) times as large: answers were seen to differ from linearity by
/// 2.4e-10 with eps mu = 1e-6.
double error_of_answers(const Fluid& fluid) {
  constexpr double kError = 1e-9, kErrorByPenalty = 1e-15;
  if (fluid.constraint != RigidConstraint::kPenalty) return kError;
  return std::max(kError, kErrorByPenalty / fluid.penalty);
}

double largest_of(std::span<const double> numbers) {
  double largest = 0;
  for (const double x : numbers) largest = std::max(largest, std::abs(x));
  return largest;
}

}  // namespace

/// What a step computes before it changes the state.
struct FluidSimulation::Motion {
  std::vector<double> flow;      ///< velocities in the fluid's problem: U, with contact
  std::vector<double> drag;      ///< forces of the particles on the fluid
  std::vector<double> free;      ///< U^+ without contact
  std::vector<double> moved;     ///< velocities with which the particles move: U^+ with contact
  std::vector<double> at_end;    ///< u^{n+1}
  std::vector<double> reported;  ///< u^{n+1} extrapolated from two meshes; empty without estimate
  StepContacts contact;
  FluidStepReport fluid;
  FlowQuantities quantities;
};

FluidSimulation::FluidSimulation(Setting setting, State state, std::unique_ptr<FluidSolver> solver)
    : setting_(std::move(setting)),
      state_(std::move(state)),
      solver_(std::move(solver)),
      layout_{motion_components(state_.particles.dimension)},
      mean_radius_(mean_radius(state_.particles)),
      pool_(1),
      obstacles_(obstacles_of(setting_)) {
  auto& p = state_.particles;
  p.cell = cell_of(setting_.domain);
  if (const auto* flow = std::get_if<LinearFlow>(&setting_.fluid->boundary))
    p.cell.gradient = flow->gradient;
  if (layout_.components == 3) {
    p.angles.resize(p.count());
    p.angular_velocities.resize(p.count());
  }
  wrap_into_cell(state_);
}

/// U^+ of all particles for the velocities `flow` = U without contact.
std::vector<double> FluidSimulation::free_velocities(const StepEquation& equation,
                                                     std::span<const double> flow, double h) {
  std::vector<double> free(flow.begin(), flow.end());
  const auto& earlier = state_.earlier_velocities;
  if (earlier.size() != free.size() || state_.earlier_forces.size() != free.size() ||
      !(state_.earlier_step > 0) || !equation.drives_as_before(state_.earlier_step))
    return free;
  const auto now = equation.right_side();
  std::vector<double> difference(free.size());
  for (std::size_t i = 0; i < free.size(); ++i)
    difference[i] = state_.earlier_forces[i] + equation.inertia()[i] * earlier[i] - now[i];
  std::vector<double> changed(flow.begin(), flow.end());
  if (largest_of(difference) > 0) {
    const auto added = solver_->velocities(difference, false);
    for (std::size_t i = 0; i < changed.size(); ++i) changed[i] += added[i];
  }
  const double share = h / (2 * state_.earlier_step);
  for (std::size_t i = 0; i < free.size(); ++i) {
    const auto k = static_cast<std::int32_t>(i / layout_.components);
    if (!equation.is_in_contact(k) && !equation.is_driven(k))
      free[i] += share * (changed[i] - earlier[i]);
  }
  return free;
}

StepContacts FluidSimulation::solve_contacts_of(const StepEquation& equation,
                                                std::span<const double> free, double h,
                                                double next) {
  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  const auto is_movable = [&](std::int32_t k) {
    return !equation.is_driven(k) && !(is_split && equation.inertia()[layout_.at(k, 0)] == 0);
  };
  const Mobility mobility = [&](std::span<const double> loads) {
    if (!is_split) return solver_->velocities(loads, false);
    std::vector<double> velocities(loads.size());
    for (std::size_t i = 0; i < loads.size(); ++i)
      if (is_movable(static_cast<std::int32_t>(i / layout_.components)) &&
          equation.inertia()[i] > 0)
        velocities[i] = loads[i] / equation.inertia()[i];
    return velocities;
  };
  const auto places = positions_of(obstacles_, next);
  const ContactConditions conditions{h,
                                     setting_.fluid->threshold_gap,
                                     places,
                                     mean_radius_,
                                     error_of_answers(*setting_.fluid),
                                     setting_.solver,
                                     is_movable};
  return solve_contacts(state_, free, mobility, conditions, pool_);
}

/// Computes a step of length h that ends at `next`.
FluidSimulation::Motion FluidSimulation::solve(double h, double next, bool is_estimated) {
  const auto begin = Clock::now();
  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  Motion motion;
  StepEquation equation(setting_, state_, h, next);
  std::vector<double> forces;
  // An impact changes the inertia of its particles, and with it the problem.
  for (int iterations = 0;;) {
    solver_->place(equation.bodies());
    forces = equation.right_side();
    motion.flow = solver_->velocities(forces, true);
    motion.free = free_velocities(equation, motion.flow, h);
    motion.contact = solve_contacts_of(equation, motion.free, h, next);
    iterations += motion.contact.iterations;
    motion.contact.iterations = iterations;
    if (!equation.put_in_contact(motion.contact.contacts)) break;
  }
  motion.moved = motion.contact.velocities;
  if (largest_of(motion.contact.loads) > 0 && !is_split) {
    // The flow, and the forces of the fluid, are those with the contact forces.
    const auto before = motion.flow;
    for (std::size_t i = 0; i < forces.size(); ++i) forces[i] += motion.contact.loads[i];
    motion.flow = solver_->velocities(forces, true);
    for (std::size_t i = 0; i < before.size(); ++i)
      motion.moved[i] = motion.free[i] + (motion.flow[i] - before[i]);
  }
  motion.drag = forces;
  for (std::size_t i = 0; i < forces.size(); ++i)
    motion.drag[i] -= equation.inertia()[i] * motion.flow[i];
  motion.at_end = equation.velocities_at_end(motion.moved, motion.flow);
  if (is_estimated) estimate(equation, forces, motion);
  motion.quantities = solver_->quantities();
  motion.fluid.dissipation = motion.quantities.dissipation;
  motion.fluid.apparent_viscosity = motion.quantities.apparent_viscosity;
  motion.fluid.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  return motion;
}

/// Asks for the flow on two meshes under the same forces, with those of contacts.
void FluidSimulation::estimate(const StepEquation& equation, std::span<const double> forces,
                               Motion& motion) {
  const auto estimate = solver_->estimate(forces);
  motion.fluid.velocity_error = estimate.relative_error;
  motion.fluid.velocity_error_of_one_mesh = estimate.relative_error_of_one_mesh;
  motion.fluid.velocity_error_of_penalty = estimate.relative_error_of_penalty;
  if (setting_.fluid->coupling == Coupling::kSplitting) return;
  auto moved = motion.moved;
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] += estimate.velocities[i] - motion.flow[i];
  motion.reported = equation.velocities_at_end(moved, estimate.velocities);
}

/// Throws Error(kNotConverged) if the step cannot be accepted; otherwise fills the report.
void FluidSimulation::examine(const Motion& motion, double h, StepReport& report) const {
  const double largest = largest_resolved_distance(setting_.solver.tolerance, mean_radius_);
  const double longest = h * fastest(motion.moved, layout_);
  if (!(longest < largest))
    throw Error(ErrorKind::kNotConverged,
                fmt::format("a particle moves by {} in the step to time {}, too far for the "
                            "precision of a double; check the forces and the time step",
                            longest, report.time));
  const auto residuals =
      measure_residuals(motion.contact.contacts, motion.free, motion.moved, h, layout_,
                        setting_.solver, mean_radius_, error_of_answers(*setting_.fluid));
  if (!residuals.converged && -residuals.smallest_gap > mean_radius_)
    throw Error(ErrorKind::kNotConverged,
                fmt::format("no solution of the step to time {} was found: particles would overlap "
                            "by {:.3g} mean radii; is the time step too long for the forces, or do "
                            "particles with given motions leave the others too little room?",
                            report.time, -residuals.smallest_gap / mean_radius_));
  report.converged = residuals.converged;
  report.residual = residuals.largest / mean_radius_;
  report.impulse_residual = residuals.largest_relative;
  report.largest_overlap = (0 - residuals.smallest_gap) / mean_radius_;
}

/// Changes the state by a step.
void FluidSimulation::accept(Motion motion, double h, double next, StepReport& report) {
  auto& p = state_.particles;
  state_.pairs = std::move(motion.contact.pairs.pairs);
  state_.walls = std::move(motion.contact.pairs.walls);
  const auto errors =
      measure_residuals(motion.contact.contacts, motion.free, motion.moved, h, layout_,
                        setting_.solver, mean_radius_, error_of_answers(*setting_.fluid))
          .impulse_errors;
  const auto radius = [&](std::int32_t k) {
    return k < 0 ? std::numeric_limits<double>::infinity() : p.radii[index_of(k)];
  };
  std::size_t c = 0;
  for (auto* pairs : {&state_.pairs, &state_.walls})
    for (auto& pair : *pairs) {
      const auto& contact = motion.contact.contacts[c];
      pair.impulse = contact.impulse;
      if (contact.w > 0) {
        ++report.contacts;
        absorb_impulse(pair, errors[c],
                       setting_.law.lower_bound(radius(pair.second), radius(pair.first)));
      }
      if (pair.gamma < 0) ++report.glued;
      ++c;
    }
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
  state_.earlier_velocities = std::move(motion.flow);
  state_.earlier_forces = std::move(motion.drag);
  state_.earlier_step = h;
  state_.time = next;
  wrap_into_cell(state_);
  quantities_ = std::move(motion.quantities);
  reported_ = std::move(motion.reported);
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
  auto motion = solve(h, next, state_.steps == 0 || next >= end - tiny);
  report.iterations = motion.contact.iterations;
  report.fluid = motion.fluid;
  report.parts = 1;
  examine(motion, h, report);
  accept(std::move(motion), h, next, report);
  ++state_.steps;
  if (is_cut) {
    state_.grid_time = next;
    state_.grid_step = state_.steps;
  }
  return report;
}

FlowField FluidSimulation::flow_at_present() {
  const double h = setting_.time_step;
  solve(h, state_.time + h, false);
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
