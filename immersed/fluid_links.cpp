// Changes the velocities of a step in a fluid until bodies and links hold at its end to the
// tolerance, docs/physics.md (6.7); the rows hold them to first order in the motion only.

#include <cassert>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/immersed/contacts/fluid_contacts.hpp"
#include "viscontact/immersed/fluid_motion.hpp"
#include "viscontact/immersed/fluid_simulation.hpp"
#include "viscontact/immersed/links/constrained_motion.hpp"
#include "viscontact/immersed/step_equation.hpp"
#include "viscontact/particles/contact/shaped_contacts.hpp"

namespace viscontact::particles {
namespace {

/// Free choices of the corrections and of the turns of links.
struct FluidLinkTuning {
  // Corrections end when no length or place is off by more than kOfTolerance times the error that
  // solver.tolerance allows, so that errors do not add up over the steps. Each correction
  // multiplies the error by about the angle [rad] by which a body or an arm turns in the step, so
  // that few are needed unless this angle is about 1.
  static constexpr double kOfTolerance = 1e-3;
  static constexpr int kMostChanges = 20;
  // One half of the allowed residuals of contacts is left for errors of the velocities that the
  // fluid solver computes at last.
  static constexpr double kShareOfAllowed = 0.5;
  // Tensions that are off by this share turn links by a share of the turn of the step.
  static constexpr double kFollowed = 0.02;
  // Along a side, where the nearest points slide on it, the arm is 0 up to this part of the radius.
  static constexpr double kRounding = 1e-9;
};

}  // namespace

std::vector<double> FluidSimulation::hold_after_step(const StepEquation& equation,
                                                     const ConstrainedMotion& constrained,
                                                     std::span<const double> flow,
                                                     std::vector<double>& velocities, double h,
                                                     bool& holds) const {
  assert(flow.size() == velocities.size());
  const auto of_flow = constrained_solver_->row_forces();
  auto forces = of_flow;
  // `velocities` were extrapolated from `flow`; the forces of the rows that belong to the
  // difference are added.
  auto extrapolated = velocities;
  for (std::size_t i = 0; i < flow.size(); ++i) extrapolated[i] -= flow[i];
  add_elements(constrained_solver_->row_forces_for(extrapolated), forces);
  const auto thetas = constrained_solver_->thetas();
  const bool with_springs = !equation.link_times().empty();
  const double allowed = tolerated_length();
  double off = 0;  // [L]
  for (int n = 0; n <= FluidLinkTuning::kMostChanges; ++n) {
    const auto missing =
        constrained.missing(velocities, forces, thetas, constrained_solver_->stiffnesses());
    off = h * largest_magnitude(missing);
    if (off <= FluidLinkTuning::kOfTolerance * allowed || n == FluidLinkTuning::kMostChanges) break;
    add_elements(constrained_solver_->change(velocities, missing, with_springs), forces);
  }
  holds = off <= allowed;
  if (!(off <= mean_radius_))
    throw Error(ErrorKind::kNotConverged,
                "the links do not hold in the step to time {}: a length or place would be off by "
                "{:.3g} mean radii; is the time step too long for the velocities, or do lengths, "
                "places and given motions contradict each other?",
                state_.time + h, off / mean_radius_);
  for (std::size_t r = 0; r < forces.size(); ++r) forces[r] -= of_flow[r];
  return forces;
}

double FluidSimulation::hold_turned(const ConstrainedMotion& constrained, double h,
                                    std::vector<double>& velocities,
                                    std::vector<double>& row_forces) const {
  const auto rows = constrained.rows();
  const auto thetas = constrained_solver_->thetas();
  for (int n = 0;; ++n) {
    auto missing =
        constrained.missing(velocities, row_forces, thetas, constrained_solver_->stiffnesses());
    for (std::size_t r = 0; r < missing.size(); ++r)
      if (r >= rows.size() || rows[r].is_spring()) missing[r] = 0;
    const double off = h * largest_magnitude(missing);
    if (off <= FluidLinkTuning::kOfTolerance * tolerated_length() ||
        n == FluidLinkTuning::kMostChanges)
      return off;
    add_elements(constrained_solver_->change(velocities, missing, false), row_forces);
  }
}

void FluidSimulation::hold_with_contacts(const StepEquation& equation,
                                         const ConstrainedMotion& constrained, double h,
                                         double next, Motion& motion,
                                         std::vector<double>& row_forces) {
  auto& contact = motion.contact;
  if (!has_links_ || motion.impact || !(largest_magnitude(contact.loads) > 0)) return;
  const double allowed = FluidLinkTuning::kOfTolerance * tolerated_length();
  for (int round = 0; round < FluidLinkTuning::kMostChanges; ++round) {
    auto velocities = motion.linear;
    for (std::size_t i = 0; i < velocities.size(); ++i)
      velocities[i] += contact.velocities[i] - motion.free[i];
    const auto before = velocities;
    const double off = hold_turned(constrained, h, velocities, row_forces);
    const auto moved = constrained.with_finite_turns(velocities);
    double change = 0;  // [L/T]
    for (std::size_t i = 0; i < velocities.size(); ++i) {
      const double by = moved[i] - contact.velocities[i];
      const double lever = i % layout_.components < layout_.directions() ? 1 : mean_radius_;
      change = largest_or_nan(change, lever * std::abs(by));
      motion.linear[i] += velocities[i] - before[i];
      motion.free[i] += by;
      contact.velocities[i] += by;
    }
    motion.links_hold = off <= tolerated_length() && h * change <= allowed;
    // The contacts need not be solved again if their residuals stay allowed. They may be allowed
    // less than `allowed`, because the impulse of a light load is as exact as that of a large one.
    if (h * change <= allowed &&
        (!contact.is_solved ||
         residuals_of(contact, contact.velocities, contact_conditions(motion.free, h)).excess <=
             FluidLinkTuning::kShareOfAllowed))
      return;
    const int iterations = contact.iterations;
    motion.impact = solve_contacts_of(equation, motion.free, h, next, contact);
    contact.iterations += iterations;
    if (motion.impact) return;
  }
}

std::vector<Contact<2>> FluidSimulation::contacts_before(double h) const {
  std::vector<Contact<2>> contacts;
  if (layout_.components != 3) return contacts;
  const auto places = positions_of(obstacles_, state_.time);
  for (const auto* list : {&state_.pairs, &state_.walls})
    for (const auto& pair : *list) {
      if (pair.impulse == 0 || !is_round(state_.particles, pair)) continue;
      contacts.push_back(contact_of<2>(state_.particles, pair, places));
      contacts.back().impulse *= h / impulse_time_of(h);
    }
  return contacts;
}

bool FluidSimulation::follow_turns(const StepEquation& equation, ConstrainedMotion& constrained,
                                   std::vector<double> loaded, std::span<const Contact<2>> contacts,
                                   std::span<const double> row_forces,
                                   std::vector<double>& settled) {
  const auto before = constrained.geometric_rows().size();
  constrained.add_turns({row_forces, equation.forces(), contacts, equation.largest_mobility()});
  const auto rows = constrained.geometric_rows();
  if (rows.empty() || (rows.size() == before && loaded == settled)) return false;
  constrained_solver_->turn_with(rows);
  const bool changed = constrained_solver_->settle_stiffnesses(loaded, FluidLinkTuning::kFollowed);
  settled = std::move(loaded);
  return changed || rows.size() > before;
}

double FluidSimulation::turn_of_films(const StepContacts& step,
                                      const StepEquation& equation) const {
  const bool is_split = setting_.fluid->coupling == Coupling::kSplitting;
  const auto& p = state_.particles;
  if (layout_.components != 3 || (!p.has_other_shapes() && !is_split)) return 0;
  auto mobility = equation.largest_mobility();
  if (is_split) {
    const auto inertia = equation.inertia_of_projection();
    for (std::size_t i = 0; i < mobility.size(); ++i)
      mobility[i] = mobility[i] > 0 && inertia[i] > 0 ? 1 / inertia[i] : 0;
  }
  struct Film {
    std::int32_t first, second;
    double of_arms;  // part of z that is due to arms that turn [1]
  };
  std::vector<Film> films;
  // The sum of the rates of all films at each particle, with its own mobility. The largest sum of
  // two particles of one film bounds the rate of a whole chain (Anderson & Morley 1985).
  std::vector<double> rates(p.count());
  for (std::size_t c = 0; c < step.circles.size(); ++c) {
    const auto& contact = step.contacts[c];
    if (!(contact.impulse < 0)) continue;
    const auto& [radii, arms] = step.circles[c];
    double length = contact.gap;
    bool has_arm = false, has_side = false;
    Film film{contact.first, contact.second, 0};
    for (const std::size_t one : {0U, 1U}) {
      const auto k = one == 0 ? contact.first : contact.second;
      if (k < 0) continue;
      const auto i = index_of(k);
      length += one == 0 ? radii.first : radii.second;
      const double arm = std::abs(arms[one]);
      has_arm = has_arm || arm > FluidLinkTuning::kRounding * p.radii[i];
      has_side =
          has_side || (p.shape(i).sides() > 0 && !(arm > FluidLinkTuning::kRounding * p.radii[i]));
      film.of_arms = std::max(film.of_arms, -contact.impulse * arm * mobility[layout_.at(k, 2)]);
    }
    if (has_side || (!has_arm && !is_split)) continue;
    films.push_back(film);
    // The direction of a film at a wall does not turn.
    if (contact.first < 0 || !(length > 0)) continue;
    for (const std::size_t one : {0U, 1U}) {
      const auto k = one == 0 ? contact.first : contact.second;
      rates[index_of(k)] -= contact.impulse / length *
                            (std::max(mobility[layout_.at(k, 0)], mobility[layout_.at(k, 1)]) +
                             arms[one] * arms[one] * mobility[layout_.at(k, 2)]);
    }
  }
  double largest = 0;
  for (const auto& film : films)
    largest = std::max(largest, film.of_arms + rates[index_of(film.second)] +
                                    (film.first < 0 ? 0 : rates[index_of(film.first)]));
  return largest;
}

std::vector<double> FluidSimulation::hold_at_end(const StepEquation& equation,
                                                 const ConstrainedMotion& constrained,
                                                 std::span<const double> moved,
                                                 std::vector<double>& at_end) const {
  // Without this change, a part of the velocities that a link does not allow would remain, and
  // change its sign in each step.
  std::vector<char> is_stiff;
  for (std::size_t r = 0; r < constrained_solver_->row_forces().size(); ++r)
    is_stiff.push_back(constrained_solver_->is_stiff(r) ? 1 : 0);
  auto velocities = at_end;
  auto forces = constrained.hold_at_end(moved, equation.mobility_of_step(), is_stiff, velocities);
  for (std::size_t i = 0; i < at_end.size(); ++i)
    if (equation.link_times()[i / layout_.components] >= 0) at_end[i] = velocities[i];
  return forces;
}

}  // namespace viscontact::particles
