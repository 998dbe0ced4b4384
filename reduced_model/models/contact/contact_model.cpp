// The steps of contact_step.hpp and rebound.hpp, their budget, and when contact begins and ends.
#include "viscontact/reduced_model/models/contact/contact_model.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/models/contact/contact_step.hpp"
#include "viscontact/reduced_model/models/contact/rebound.hpp"

namespace viscontact::reduced_model {
namespace {

/// A ResolvedDrag as functions of the distance D [L], the gap less the gap of contact, in the form
/// of NoDrag (contact_step.hpp).
class DragAtDistance {
 public:
  static constexpr bool kResolved = true;

  DragAtDistance(const ResolvedDrag& drag, double contact_gap)
      : drag_(drag), contact_gap_(contact_gap) {
    assert(contact_gap >= 0);
  }

  double impulse(double from, double to) const {
    return from == to ? 0 : drag_.impulse(contact_gap_ + to) - drag_.impulse(contact_gap_ + from);
  }

  /// The distance at the end of the step is >= 0.
  double velocity(const ContactSetting& setting, double distance, double momentum) const {
    assert(!(distance < 0));
    // With the mass m, the length h of the step, the distance D at its beginning and a primitive
    // Gamma_res of the resistance, the velocity v solves m v + Gamma_res(D + h v) - Gamma_res(D) =
    // momentum. The left side increases with v, so that the root is between 0 and the velocity
    // without drag. Where the resistance falls with the gap, the function is concave, and Newton's
    // method from v = 0 converges to the root from below. The bracket makes the method safe for
    // fits whose resistance does not fall.
    const double free = momentum * setting.per_mass;
    const double low = std::max(-distance * setting.per_step, std::min(0.0, free));
    // At the wall opposite the drag is infinite, or it is neglected and the motion ends there.
    const double last = motion_ends_at(drag_.largest_gap) - contact_gap_ - distance;
    const double high = std::min(std::max(0.0, free), std::max(0.0, last * setting.per_step));
    const auto excess_and_slope = [&](double v) {
      // At the lower end of the bracket rounding errors could make it negative.
      const double to = std::max(0.0, distance + setting.step * v);
      return std::pair(setting.mass * v + impulse(distance, to) - momentum,
                       setting.mass + setting.step * drag_.resistance(contact_gap_ + to));
    };
    // A change of the velocity that is within its rounding error does not change the next gap.
    const auto settled = [](double v, double next) {
      constexpr double kRoundOff = 4 * std::numeric_limits<double>::epsilon();
      return std::abs(next - v) <= kRoundOff * std::abs(next);
    };
    if (high < free && excess_and_slope(high).first < 0) return high;
    return bracketed_newton(0, low, high, Bracket::kClosed, excess_and_slope, settled);
  }

 private:
  const ResolvedDrag& drag_;
  double contact_gap_;
};

/// A step from `begin` to `end` [T], in which the external force acts by its impulse from
/// `impulse_begin` to `impulse_end`. The latter differ from the former only if the model is
/// staggered.
struct StepTimes {
  double begin = 0, end = 0, impulse_begin = 0, impulse_end = 0;
};

/// Adds a step to the budget; `push` is the impulse of the external force. The work of each impulse
/// is the impulse times the mean of the velocities before and after the step, so that the works add
/// up to the change of kinetic energy exactly.
void add_to(MomentumEnergyBudget& budget, double velocity_before, double push,
            const ContactStep& step) {
  const double velocity = (velocity_before + step.state.velocity) / 2;
  budget.external_work += velocity * push;
  if (step.film != 0 || step.solid != 0) {
    budget.film_impulse += step.film;
    budget.film_work += velocity * step.film;
    budget.solid_impulse += step.solid;
    budget.solid_work += velocity * step.solid;
  }
  if (step.drag != 0) {
    budget.drag_impulse += step.drag;
    budget.drag_work += velocity * step.drag;
  }
}

/// Finds the times [T] at which contact begins first and ends last, within steps.
class ContactClock {
 public:
  explicit ContactClock(double mass) : mass_(mass) {}

  void look_at(const StepTimes& times, const ContactState& before, double push,
               const ContactStep& step) {
    if (std::exchange(had_impacts_, false)) return;
    const bool contact =
        step.state.gap == 0 && (step.state.gamma < 0 || step.film != 0 || step.solid != 0);
    const auto [time, next, impulse_begin, impulse_end] = times;
    const double h = next - time;
    if (contact && !touching_) {
      // Without contact the sphere would reach the gap of contact after this fraction of the step.
      const double fall = -(before.velocity + push / mass_) * h;
      if (!interval_) interval_ = {time + h * (before.gap < fall ? before.gap / fall : 0), next};
    }
    if (contact) {
      (*interval_)[1] = next;
    } else if (touching_) {
      // The momentum at the beginning and the impulse of the force together raise gamma; gamma is 0
      // when this fraction of both has acted.
      const double rise = mass_ * before.velocity + push;
      const double share = before.gamma < 0 && rise > 0 ? -before.gamma / rise : 0;
      (*interval_)[1] = impulse_begin + (impulse_end - impulse_begin) * std::min(1.0, share);
    }
    touching_ = contact;
  }
  /// Takes the times of contact from a step of rebound.hpp. The next call of look_at(), for the
  /// same step, then does nothing.
  void look_at_impacts(const StepTimes& times, const ReboundStep& step) {
    if (!interval_) interval_ = {times.begin + step.first_impact, 0};
    touching_ = step.state.gap == 0;
    (*interval_)[1] = touching_ ? times.end : times.begin + step.last_impact;
    had_impacts_ = true;
  }
  std::optional<std::array<double, 2>> interval() const { return interval_; }

 private:
  double mass_;
  std::optional<std::array<double, 2>> interval_;
  bool touching_ = false, had_impacts_ = false;
};

/// The first touch of the solids, in the first step in which they carry a load. Before this step
/// gamma is above model.gamma_min. Contact began at the time `landing`; `push` is the impulse of
/// the external force.
SolidTouch touch_in(const ContactModel& model, double mass, double landing, const StepTimes& times,
                    const ContactState& before, double push, const ContactStep& step) {
  // If gamma was 0 before, the sphere landed in this step: the film takes a part of its momentum,
  // and the solids take the rest.
  if (!(before.gamma < 0)) return {landing, step.state.velocity - step.solid / mass};
  const double rest = before.gamma + mass * before.velocity - model.gamma_min;
  if (rest <= 0) return {times.impulse_begin, rest / mass};
  const double duration = times.impulse_end - times.impulse_begin;
  return {times.impulse_begin + duration * std::min(1.0, -rest / push),
          push / (duration * model.solid_resistance)};
}

/// The state after the impulse `push` of the external force at one instant, at which the gap does
/// not change, and the impulses of film and solids.
ContactStep after_impulse(const ContactState& state, double push, const ContactSetting& setting) {
  ContactStep step{state};
  const double momentum = setting.mass * state.velocity + push;
  if (state.gap > 0) {
    step.state.velocity = momentum * setting.per_mass;
    return step;
  }
  const double gamma = state.gamma + momentum;
  step.state.velocity = std::max(0.0, gamma) * setting.per_mass;
  step.state.gamma = std::clamp(gamma, setting.gamma_min, 0.0);
  step.film = state.gamma - step.state.gamma;
  step.solid = step.state.gamma - std::min(gamma, 0.0);
  return step;
}

ContactStep as_contact_step(const ReboundStep& step) {
  return {step.state, step.budget.film_impulse, step.budget.drag_impulse,
          step.budget.solid_impulse};
}

/// Makes the steps from the start to the end. Calls `rebound(times, step)` for each step with
/// impacts, `add_impulse(velocity before, push, step)` for each other impulse `push` of the
/// external force, and `add(times, setting, state before, push, step, state at the end)` after each
/// step. `turns` are the times at which the force changes its sign, increasing. In a staggered
/// model the impulses before and after such a time act one after the other, because the solids
/// carry the impulse before it, and must not give this impulse back to the sphere afterwards. In a
/// step in which the sphere reaches the wall opposite, the motion ends early, and the row has the
/// time of that. Returns the end of the last step.
template <class Drag, class Rebounding, class AddImpulse, class Add>
double run_steps(const Motion& motion, const ContactModel& model, const Drag& drag,
                 std::span<const double> turns, const Rebounding& rebound,
                 const AddImpulse& add_impulse, const Add& add) {
  const double end = motion.end_time;
  const double h = motion.parameter(kContactTimeStep);
  const int steps = step_count(end, h);
  const double last = motion_ends_at(model.largest_gap) - model.contact_gap;
  ContactSetting setting(motion.mass, model.gamma_min, h);
  ContactState state{motion.initial_gap - model.contact_gap, motion.initial_velocity, 0};
  // A ForceWalk must be asked for times that do not decrease. Means over half steps and over whole
  // steps are needed in turn, so that each kind of mean has a ForceWalk of its own.
  ForceWalk force(motion.external_force), force_of_half(motion.external_force),
      force_of_step(motion.external_force);
  auto turn = turns.begin();
  double t = 0, since = 0;
  for (int n = 0; n < steps; ++n) {
    const double next = step_time(n + 1, steps, end, h);
    if (n + 1 == steps) setting = ContactSetting(motion.mass, model.gamma_min, next - t);
    if (n % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    StepTimes times{t, next, since, next};
    const ContactState before = state;
    ContactStep earlier;
    double push = setting.step;
    if (model.is_staggered) {
      times.impulse_end = t + setting.step / 2;
      for (; turn != turns.end() && *turn < times.impulse_end; ++turn) {
        const double part = (*turn - since) * force.mean(since, *turn);
        const auto step = after_impulse(state, part, setting);
        add_impulse(state.velocity, part, step);
        earlier.film += step.film;
        earlier.solid += step.solid;
        state = step.state;
        since = *turn;
      }
      push = times.impulse_end - since;
    }
    push *= force.mean(since, times.impulse_end);
    ContactStep step;
    std::optional<ReboundStep> step_with_impacts;
    if (model.restitution > 0 && state.gamma == 0 && (state.gap > 0 || state.velocity > 0))
      step_with_impacts = rebound_step(state, push, force_of_step.mean(t, next) * setting.per_mass,
                                       setting, model.restitution, drag);
    if (step_with_impacts) {
      step = as_contact_step(*step_with_impacts);
      rebound(times, *step_with_impacts);
    } else {
      step = contact_step(state, push, setting, drag);
      add_impulse(state.velocity, push, step);
    }
    step.film += earlier.film;
    step.solid += earlier.solid;
    ContactState at_end = step.state;
    const bool ends = at_end.gap >= last;  // at the wall opposite
    if (model.is_staggered) {
      const double rest = (next - times.impulse_end) * force_of_half.mean(times.impulse_end, next);
      const auto at_end_step = after_impulse(step.state, rest, setting);
      at_end = at_end_step.state;
      if (n + 1 == steps || ends) add_impulse(step.state.velocity, rest, at_end_step);
    }
    if (ends) {
      // The gap is linear within a step of the scheme.
      const double share = (last - before.gap) / (at_end.gap - before.gap);
      times.end = at_end.gap > last ? t + share * (next - t) : next;
      at_end.gap = last;
    }
    add(times, setting, before, push, step, at_end);
    if (ends) return next;
    state = step.state;
    t = next;
    since = times.impulse_end;
  }
  return end;
}

/// The times at which the force changes its sign; none if there are too many of them to find, so
/// that the lowest gamma is taken from the ends of the steps only.
std::vector<double> turns_of(const Motion& motion) {
  try {
    return motion.external_force.sign_changes(motion.end_time);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

Trajectory run_contact_model(const Motion& motion, ContactModel model) {
  assert(motion.initial_gap >= model.contact_gap && model.gamma_min <= 0);
  assert(!(model.is_staggered && model.drag));
  model.restitution = motion.restitution();
  Trajectory trajectory;
  trajectory.steps = step_count(motion.end_time, motion.parameter(kContactTimeStep));
  trajectory.rows.reserve(static_cast<std::size_t>(trajectory.steps) + 1);
  const double drag_at_start =
      model.drag ? -model.drag->resistance(motion.initial_gap) * motion.initial_velocity : 0;
  trajectory.rows.push_back({0, motion.initial_gap, motion.initial_velocity, drag_at_start,
                             motion.external_force.value(0), 0.0, 0.0});
  const auto turns = turns_of(motion);
  auto turn = turns.begin();
  MomentumEnergyBudget budget;
  ContactClock clock(motion.mass);
  double lowest_gamma = 0;
  bool is_rebound = false;  // whether the step has impacts
  ForceWalk force(motion.external_force);
  const auto add = [&](const StepTimes& times, const ContactSetting& setting,
                       const ContactState& before, double push, const ContactStep& step,
                       const ContactState& end) {
    const double per_time = times.impulse_end == times.end && times.impulse_begin == times.begin
                                ? setting.per_step
                                : 1 / (times.impulse_end - times.impulse_begin);
    trajectory.rows.push_back({times.end, model.contact_gap + end.gap, end.velocity,
                               (step.film + step.drag) * per_time, force.value(times.end),
                               end.gamma, step.solid * per_time});
    clock.look_at(times, before, push, step);
    if (step.solid > 0 && !is_rebound && !trajectory.solid_contact_from)
      trajectory.solid_contact_from =
          touch_in(model, motion.mass, clock.interval().value()[0], times, before, push, step);
    is_rebound = false;
    lowest_gamma = std::min(lowest_gamma, end.gamma);
    // In contact, gamma is lowest where the force changes its sign within the step.
    const double begin = times.impulse_begin;
    for (; turn != turns.end() && *turn < times.impulse_end; ++turn)
      if (*turn > begin && before.gamma < 0 && step.state.gamma < 0)
        lowest_gamma = std::min(
            lowest_gamma, std::max(model.gamma_min,
                                   before.gamma + motion.mass * before.velocity +
                                       (*turn - begin) * motion.external_force.mean(begin, *turn)));
  };
  const auto rebound = [&](const StepTimes& times, const ReboundStep& step) {
    is_rebound = true;
    if (!step.rebounds.empty() && !trajectory.solid_contact_from) {
      const auto& first = step.rebounds.front();
      trajectory.solid_contact_from = {times.begin + first.time,
                                       -first.solid_impulse / motion.mass};
    }
    for (auto of : step.rebounds) {
      of.time += times.begin;
      trajectory.rebounds.push_back(of);
    }
    clock.look_at_impacts(times, step);
    lowest_gamma = std::min(lowest_gamma, step.lowest_gamma);
    for (const auto& entry : kBudgetEntries) budget.*entry.value += step.budget.*entry.value;
  };
  const auto add_impulse = [&](double velocity, double push, const ContactStep& step) {
    add_to(budget, velocity, push, step);
  };
  const double end = model.drag
                         ? run_steps(motion, model, DragAtDistance(*model.drag, model.contact_gap),
                                     turns, rebound, add_impulse, add)
                         : run_steps(motion, model, NoDrag(), turns, rebound, add_impulse, add);
  trajectory.steps = static_cast<long>(trajectory.rows.size()) - 1;
  if (lowest_gamma < 0 && model.film_thickness)
    trajectory.film_from_gamma = model.film_thickness(lowest_gamma);
  trajectory.contact_interval = clock.interval();
  budget.external_impulse = motion.external_force.impulse(end);
  trajectory.budget = budget;
  return trajectory;
}

}  // namespace viscontact::reduced_model
