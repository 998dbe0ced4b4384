// Rebounds of the sphere from the solid wall through the film, physics.md (4.12), (4.13). An impact
// takes place at its time within a step, without which heights of rebounds do not converge.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "viscontact/reduced_model/models/contact/contact_step.hpp"
#include "viscontact/reduced_model/trajectory.hpp"

namespace viscontact::reduced_model {

/// What an impact does to the sphere with the mass m and the velocity u: momenta and impulses [M
/// L/T]. gamma is minus the impulse that the film has absorbed.
struct Impact {
  double momentum = 0;       ///< m u+ after the impact, >= 0; 0 if the sphere stays
  double gamma = 0;          ///< gamma+ after the impact, <= 0; 0 if the sphere leaves the film
  double lowest_gamma = 0;   ///< in the impact, <= 0
  double solid_impulse = 0;  ///< impulse that the solids took up in the compression, s >= 0
  /// Impulse that the solids gave back, >= 0: e_d s with the restitution e_d, or less if the sphere
  /// stays.
  double restitution = 0;
};

/// The impact of a sphere with `momentum` = m u < 0 on a film with gamma = 0 (4.12). The film takes
/// the momentum until gamma = gamma_min; the solids take the rest s, and give back the impulse e_d
/// s (Poisson's law). The sphere must then pull the film open:
///
///     s = max(-m u + gamma_min, 0),   m u+ = max(gamma_c + e_d s, 0),
///     gamma+ = min(gamma_c + e_d s, 0),
///
/// where gamma_c = m u + s is gamma at the end of the compression. `gamma_min` <= 0 may be
/// -infinity; `restitution` = e_d is 0 to 1. If m u+ is below `least` >= 0, the sphere stays, so
/// that the infinitely many bounces of a sphere without a film end.
inline Impact impact_through_film(double momentum, double gamma_min, double restitution,
                                  double least) {
  assert(gamma_min <= 0 && least >= 0 && 0 <= restitution && restitution <= 1);
  Impact impact;
  impact.lowest_gamma = std::max(momentum, gamma_min);
  impact.solid_impulse = impact.lowest_gamma - momentum;
  impact.restitution = restitution * impact.solid_impulse;
  const double after = impact.lowest_gamma + impact.restitution;
  impact.momentum = std::max(after, 0.0);
  impact.gamma = std::min(after, 0.0);
  if (impact.momentum < least) impact.restitution -= std::exchange(impact.momentum, 0.0);
  return impact;
}

/// Adds an impact with `velocity` < 0. The work of each impulse is the impulse times half of
/// `velocity` in the compression, and times half the velocity after the impact in the restitution,
/// so that film and solids share the energy as they share the impulse.
inline void add_impact(MomentumEnergyBudget& budget, double mass, double velocity,
                       const Impact& impact) {
  const double leaving = impact.momentum / mass;
  const double pulled = impact.gamma - impact.lowest_gamma;  // what the film takes back, >= 0
  budget.film_impulse -= impact.lowest_gamma + pulled;
  budget.film_work -= impact.lowest_gamma * velocity / 2 + pulled * leaving / 2;
  budget.solid_impulse += impact.solid_impulse + impact.restitution;
  budget.solid_work += impact.solid_impulse * velocity / 2 + impact.restitution * leaving / 2;
}

/// Free choices of impacts.
struct BounceTuning {
  /// A flight that is shorter than this fraction of the step (scheme of time steps) or of the
  /// duration of the motion (exact times) counts as rest, so that the infinitely many bounces of a
  /// sphere without a film end.
  static constexpr double kShortestOfStep = 1e-3, kShortestOfMotion = 1e-6;
  /// Corrections of the time of an impact with drag; each one reduces its error by about h a/u.
  static constexpr int kCorrections = 4;
};

/// A step with impacts; times count from its beginning.
struct ReboundStep {
  ContactState state;             ///< at the end of the step
  std::vector<Rebound> rebounds;  ///< impacts on the solids
  /// Impulses and works in the step, without the impulse of the external force.
  MomentumEnergyBudget budget;
  double lowest_gamma = 0;   ///< in the step [M L/T], <= 0
  double first_impact = -1;  ///< time of the first impact [T], or -1
  double last_impact = -1;   ///< time of the last impact [T], or -1
};

/// The first time t [T], 0 < t <= `end`, at which D + w t + a t^2/2 falls through 0; infinity if
/// there is no such time. D = `gap` >= 0 [L], w = `velocity` and a = `acceleration` are the values
/// at time 0. If D = 0 and w < 0, the time is 0.
inline double time_of_fall(double gap, double velocity, double acceleration, double end) {
  assert(!(gap < 0));
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const double discriminant = velocity * velocity - 2 * acceleration * gap;
  if (discriminant < 0) return kNever;
  const double root = std::sqrt(discriminant);
  // At the root the velocity is -sqrt(discriminant). Each root of the quadratic equation can be
  // written in two forms; the form used here loses no digits by cancellation.
  double time = kNever;
  if (velocity < 0)
    time = 2 * gap / (root - velocity);
  else if (acceleration < 0)
    time = (velocity + root) / -acceleration;
  return time <= end ? time : kNever;
}

/// Records the impact of a sphere with `velocity` < 0 at `time` from the beginning of a step in
/// `step`. `acceleration` is the external force divided by m. Returns the velocity after the
/// impact; 0 if the sphere stays.
inline double collide(ReboundStep& step, double time, double velocity, double acceleration,
                      const ContactSetting& setting, double restitution) {
  assert(!(time < step.last_impact));
  const double least = setting.mass * BounceTuning::kShortestOfStep * setting.step *
                       std::max(0.0, -acceleration) / 2;
  const auto impact =
      impact_through_film(setting.mass * velocity, setting.gamma_min, restitution, least);
  add_impact(step.budget, setting.mass, velocity, impact);
  const double after = impact.momentum * setting.per_mass;
  step.lowest_gamma = std::min(step.lowest_gamma, impact.lowest_gamma);
  if (step.first_impact < 0) step.first_impact = time;
  step.last_impact = time;
  if (impact.solid_impulse > 0)
    step.rebounds.push_back({time, velocity, impact.solid_impulse, after, after / -velocity});
  step.state = {0, after, impact.gamma};
  return after;
}

/// Continues a step from its last impact, after which the sphere stays in contact. `push` is the
/// impulse of the external force in the whole step.
template <class Drag>
void stay(ReboundStep& step, double push, const ContactSetting& setting, const Drag& drag) {
  assert(step.last_impact >= 0);
  const double rest = setting.step - step.last_impact;
  if (!(rest > 0)) return;
  const ContactSetting of_rest(setting.mass, setting.gamma_min, rest);
  const auto end = contact_step(step.state, push * rest / setting.step, of_rest, drag);
  const double mean = end.state.velocity / 2;
  step.budget.film_impulse += end.film;
  step.budget.film_work += mean * end.film;
  step.budget.solid_impulse += end.solid;
  step.budget.solid_work += mean * end.solid;
  step.budget.drag_impulse += end.drag;
  step.budget.drag_work += mean * end.drag;
  step.state = end.state;
  step.lowest_gamma = std::min(step.lowest_gamma, end.state.gamma);
}

/// A step that begins in flight, with gamma = 0 and with D > 0 or u > 0. `push` is the impulse of
/// the external force in the step, and `acceleration` = a [L/T^2] the mean of this force divided by
/// m. Returns nothing if the sphere does not reach contact in the step.
///
/// Without resolved drag, the gaps of the scheme, D^{n+1} = D^n + h u^{n+1}, lie on the parabola
/// with the acceleration a that begins with the velocity w = u^n + push/m - a h/2. The impacts are
/// those of this parabola, at their times, and u^{n+1} = w^{n+1} - a h/2 follows from its velocity
/// w^{n+1} at the end of the step. With drag there is at most one impact in a step. Its velocity
/// follows from the impulse of the drag on the way to contact, which is exact, and its time from
/// the mean velocity on this way.
template <class Drag>
std::optional<ReboundStep> rebound_step(const ContactState& state, double push, double acceleration,
                                        const ContactSetting& setting, double restitution,
                                        const Drag& drag) {
  assert(state.gamma == 0 && (state.gap > 0 || state.velocity > 0));
  const double m = setting.mass, h = setting.step;
  ReboundStep step;
  if constexpr (Drag::kResolved) {
    if (!(contact_step(state, push, setting, drag).state.gap == 0 && state.gap > 0)) return {};
    const double of_drag = -drag.impulse(state.gap, 0);
    const auto velocity_at = [&](double time) {
      return state.velocity + (push * time / h + of_drag) * setting.per_mass;
    };
    double time = h, velocity = velocity_at(h);
    for (int n = 0; n < BounceTuning::kCorrections && velocity < 0; ++n) {
      time = std::min(h, -2 * state.gap / (std::min(0.0, state.velocity) + velocity));
      velocity = velocity_at(time);
    }
    if (!(velocity < 0)) return {};
    step.budget.drag_impulse = of_drag;
    step.budget.drag_work = of_drag * (state.velocity + velocity) / 2;
    const double after = collide(step, time, velocity, acceleration, setting, restitution);
    if (after > 0) {
      const double rest = h - time, momentum = m * after + push * rest / h;
      if (rest > 0) {
        const ContactSetting of_rest(m, setting.gamma_min, rest);
        const double v = std::max(0.0, drag.velocity(of_rest, 0, momentum));
        step.budget.drag_impulse += m * v - momentum;
        step.budget.drag_work += (m * v - momentum) * (after + v) / 2;
        step.state = {rest * v, v, 0};
      }
    } else {
      stay(step, push, setting, drag);
    }
  } else {
    double time = 0, gap = state.gap;
    double velocity = (m * state.velocity + push) * setting.per_mass - acceleration * h / 2;
    for (;;) {
      const double fall = time_of_fall(gap, velocity, acceleration, h - time);
      if (!(fall <= h - time)) break;
      time += fall;
      gap = 0;
      velocity =
          collide(step, time, velocity + acceleration * fall, acceleration, setting, restitution);
      if (velocity > 0) continue;
      stay(step, push, setting, drag);
      break;
    }
    if (step.first_impact < 0) return {};
    if (velocity > 0) {
      const double rest = h - time;
      step.state.gap = std::max(0.0, rest * (velocity + acceleration * rest / 2));
      step.state.velocity = velocity + acceleration * (rest - h / 2);
    }
  }
  const double before = state.velocity, after = step.state.velocity;
  step.budget.external_work = m / 2 * (after - before) * (after + before) - step.budget.film_work -
                              step.budget.solid_work - step.budget.drag_work;
  return step;
}

}  // namespace viscontact::reduced_model
