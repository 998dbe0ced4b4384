// The loop over time of the contact models: the resolved drag in a step, the budget, and the
// contact interval. Equations and units are those of contact_step.hpp. A change of its results must
// raise kModelsRevision.
#include "viscontact/reduced_model/models/contact/contact_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/models/contact/contact_step.hpp"

namespace viscontact::reduced_model {
namespace {

/// A ResolvedDrag as a function of the distance D from contact, as contact_step() needs it.
class DragAtDistance {
 public:
  static constexpr bool kResolved = true;

  DragAtDistance(const ResolvedDrag& drag, double contact_gap)
      : drag_(drag), contact_gap_(contact_gap) {}

  double impulse(double from, double to) const {
    return from == to ? 0 : drag_.impulse(contact_gap_ + to) - drag_.impulse(contact_gap_ + from);
  }

  double velocity(const ContactSetting& setting, double distance, double momentum) const {
    // m v + G(D + h v) - G(D) increases with v, so the root is between 0 and the velocity without
    // drag. Where the resistance falls with the gap, the function is concave, and Newton's method
    // from rest converges to the root from below. The bracket makes the method safe for fits
    // without this property.
    const double free = momentum * setting.per_mass;
    const double low = std::max(-distance * setting.per_step, std::min(0.0, free));
    const double high = std::max(0.0, free);
    const auto excess_and_slope = [&](double v) {
      const double to = distance + setting.step * v;
      return std::pair(setting.mass * v + impulse(distance, to) - momentum,
                       setting.mass + setting.step * drag_.resistance(contact_gap_ + distance +
                                                                      setting.step * v));
    };
    // A change of the velocity below its own rounding does not change the gap at the end of the
    // step.
    const auto settled = [](double v, double next) {
      constexpr double kRoundOff = 4 * std::numeric_limits<double>::epsilon();
      return std::abs(next - v) <= kRoundOff * std::abs(next);
    };
    return bracketed_newton(0, low, high, Bracket::kClosed, excess_and_slope, settled);
  }

 private:
  const ResolvedDrag& drag_;
  double contact_gap_;
};

/// Adds a step to the budget. The work of each impulse is the impulse times the mean velocity of
/// the step, so that the works add up to the change of kinetic energy exactly.
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

/// Finds within the steps when contact begins and ends.
class ContactClock {
 public:
  explicit ContactClock(double mass) : mass_(mass) {}

  void look_at(double time, double next, const ContactState& before, double push,
               const ContactStep& step) {
    const bool contact =
        step.state.gap == 0 && (step.state.gamma < 0 || step.film != 0 || step.solid != 0);
    const double h = next - time;
    if (contact && !touching_) {
      // Without contact the sphere would reach the contact gap after this share of the step.
      const double fall = -(before.velocity + push / mass_) * h;
      if (!interval_) interval_ = {time + h * (before.gap < fall ? before.gap / fall : 0), next};
    }
    if (contact) {
      (*interval_)[1] = next;
    } else if (touching_) {
      // The momentum that the step brings raises gamma to 0 after this share of the step.
      const double rise = mass_ * before.velocity + push;
      const double share = before.gamma < 0 && rise > 0 ? -before.gamma / rise : 0;
      (*interval_)[1] = time + h * std::min(1.0, share);
    }
    touching_ = contact;
  }
  std::optional<std::array<double, 2>> interval() const { return interval_; }

 private:
  double mass_;
  std::optional<std::array<double, 2>> interval_;
  bool touching_ = false;
};

/// Makes the steps from the start to the end and calls
/// `add(time, next, setting, state before, push, force at next, step)` after each.
template <class Drag, class Add>
void run_steps(const Motion& motion, const ContactModel& model, const Drag& drag, const Add& add) {
  const double end = motion.end_time;
  const double h = motion.parameter(kContactTimeStep);
  const int steps = step_count(end, h);
  ContactSetting setting(motion.mass, model.gamma_min, h);
  ContactState state{motion.initial_gap - model.contact_gap, motion.initial_velocity, 0};
  ForceWalk force(motion.external_force);
  double t = 0;
  for (int n = 0; n < steps; ++n) {
    const double next = step_time(n + 1, steps, end, h);
    if (n + 1 == steps) setting = ContactSetting(motion.mass, model.gamma_min, next - t);
    if (n % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double push = setting.step * force.mean(t, next);
    const ContactStep step = contact_step(state, push, setting, drag);
    add(t, next, setting, state, push, force.value(next), step);
    state = step.state;
    t = next;
  }
}

/// The times at which the force changes its sign. Nothing if there are too many such times to find;
/// the lowest gamma is then taken from the ends of the steps.
std::vector<double> turns_of(const Motion& motion) {
  try {
    return motion.external_force.sign_changes(motion.end_time);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

Trajectory run_contact_model(const Motion& motion, const ContactModel& model) {
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
  const auto add = [&](double t, double next, const ContactSetting& setting,
                       const ContactState& before, double push, double force,
                       const ContactStep& step) {
    const auto& after = step.state;
    trajectory.rows.push_back({next, model.contact_gap + after.gap, after.velocity,
                               (step.film + step.drag) * setting.per_step, force, after.gamma,
                               step.solid * setting.per_step});
    add_to(budget, before.velocity, push, step);
    clock.look_at(t, next, before, push, step);
    lowest_gamma = std::min(lowest_gamma, after.gamma);
    // If contact lasts through a step in which the force changes its sign, gamma is lowest at that
    // time.
    for (; turn != turns.end() && *turn < next; ++turn)
      if (*turn > t && before.gamma < 0 && after.gamma < 0)
        lowest_gamma = std::min(
            lowest_gamma,
            std::max(model.gamma_min, before.gamma + motion.mass * before.velocity +
                                          (*turn - t) * motion.external_force.mean(t, *turn)));
  };
  if (model.drag)
    run_steps(motion, model, DragAtDistance(*model.drag, model.contact_gap), add);
  else
    run_steps(motion, model, NoDrag(), add);
  if (lowest_gamma < 0 && model.film_thickness)
    trajectory.recovered_minimal_gap = model.film_thickness(lowest_gamma);
  trajectory.contact_interval = clock.interval();
  budget.external_impulse = motion.external_force.impulse(motion.end_time);
  trajectory.budget = budget;
  return trajectory;
}

}  // namespace viscontact::reduced_model
