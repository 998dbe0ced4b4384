// The loop over time of the contact models: the resolved drag in a step, the budget, and the
// contact interval.
#include "viscontact/reduced_model/models/contact_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/reduced_model/integration/contact_step.hpp"

namespace viscontact {
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
    double low = std::max(-distance * setting.per_step, std::min(0.0, free));
    double high = std::max(0.0, free);
    double v = 0;
    double excess = -momentum;
    // A safety limit: bisection alone needs about 60 steps for each factor of 1e18.
    constexpr int kMaxSteps = 200;
    for (int step = 0; step < kMaxSteps && excess != 0; ++step) {
      (excess > 0 ? high : low) = v;
      const double slope = setting.mass + setting.step * drag_.resistance(contact_gap_ + distance +
                                                                          setting.step * v);
      double next = v - excess / slope;
      if (!(next >= low && next <= high)) next = low + (high - low) / 2;
      // A change of the velocity below its own rounding does not change the gap at the end of the
      // step.
      constexpr double kRoundOff = 4 * std::numeric_limits<double>::epsilon();
      const bool settled = std::abs(next - v) <= kRoundOff * std::abs(next);
      v = next;
      if (settled) break;
      excess = setting.mass * v + impulse(distance, distance + setting.step * v) - momentum;
    }
    return v;
  }

 private:
  const ResolvedDrag& drag_;
  double contact_gap_;
};

/// Adds a step to the budget. The work of each impulse is the impulse times the mean velocity of
/// the step, so that the works add up to the change of kinetic energy exactly.
void book(double velocity_before, double push, const ContactStep& step,
          MomentumEnergyBudget& books) {
  const double velocity = (velocity_before + step.state.velocity) / 2;
  books.external_work += velocity * push;
  if (step.film != 0 || step.solid != 0) {
    books.film_impulse += step.film;
    books.film_work += velocity * step.film;
    books.solid_impulse += step.solid;
    books.solid_work += velocity * step.solid;
  }
  if (step.drag != 0) {
    books.drag_impulse += step.drag;
    books.drag_work += velocity * step.drag;
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
  const double h = motion.contact_time_step;
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

/// The times at which the force changes its sign. Nothing if it does so too often to be followed;
/// the lowest gamma then is that at the ends of the steps.
std::vector<double> turns_of(const Motion& motion) {
  try {
    return motion.external_force.sign_changes(motion.end_time);
  } catch (const Error&) {
    return {};
  }
}

}  // namespace

ContactModel contact_with_leading_term(const Motion& motion, const LubricationForce& force) {
  const double k = force.leading_coefficient();
  const double r = force.radius();
  const double solid_gap = motion.roughness[0] + motion.roughness[1];
  ContactModel model;
  model.gamma_min = solid_gap == 0 ? -std::numeric_limits<double>::infinity()
                                   : std::min(0.0, k * std::log(solid_gap / r));
  model.film_thickness = [k, solid_gap, q0 = motion.initial_gap,
                          gamma_min = model.gamma_min](double gamma) {
    return gamma <= gamma_min ? solid_gap : std::max(solid_gap, q0 * std::exp(gamma / k));
  };
  model.film_law = "initial_gap * exp(gamma/k)";
  if (solid_gap > 0) model.film_law += ", at least the roughness heights together";
  return model;
}

Trajectory run_contact_model(const Motion& motion, const ContactModel& model) {
  Trajectory trajectory;
  trajectory.steps = step_count(motion.end_time, motion.contact_time_step);
  trajectory.rows.reserve(static_cast<std::size_t>(trajectory.steps) + 1);
  const double drag_at_start =
      model.drag ? -model.drag->resistance(motion.initial_gap) * motion.initial_velocity : 0;
  trajectory.rows.push_back({0, motion.initial_gap, motion.initial_velocity, drag_at_start,
                             motion.external_force.value(0), 0.0, 0.0});
  const auto turns = turns_of(motion);
  auto turn = turns.begin();
  MomentumEnergyBudget books;
  ContactClock clock(motion.mass);
  double lowest_gamma = 0;
  const auto add = [&](double t, double next, const ContactSetting& setting,
                       const ContactState& before, double push, double force,
                       const ContactStep& step) {
    const auto& after = step.state;
    trajectory.rows.push_back({next, model.contact_gap + after.gap, after.velocity,
                               (step.film + step.drag) * setting.per_step, force, after.gamma,
                               step.solid * setting.per_step});
    book(before.velocity, push, step, books);
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
  books.external_impulse = motion.external_force.impulse(motion.end_time);
  trajectory.books = books;
  return trajectory;
}

}  // namespace viscontact
