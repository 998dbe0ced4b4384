// Events of viscous contact (landing, release, touch of the solids), and the budget between them.
#include "viscontact/reduced_model/models/contact/viscous_contact_exact.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/models/contact/rebound.hpp"
#include "viscontact/reduced_model/models/contact/viscous_contact.hpp"

namespace viscontact::reduced_model {
namespace {

/// The state of the sphere at the last event, and the exact motion from there.
class EventDriven {
 public:
  EventDriven(const Motion& motion, const ContactModel& model)
      : m_(motion.mass),
        f_(motion.external_force),
        gamma_min_(model.gamma_min),
        solid_resistance_(model.solid_resistance),
        restitution_(motion.restitution()),
        shortest_flight_(BounceTuning::kShortestOfMotion * motion.end_time),
        last_gap_(motion_ends_at(model.largest_gap)),
        gap_(motion.initial_gap),
        velocity_(motion.initial_velocity) {}

  bool contact() const { return contact_; }
  /// True after the sphere has reached the wall opposite, where the motion ends.
  bool ended() const { return ended_; }
  const MomentumEnergyBudget& budget() const { return budget_; }
  const std::vector<Rebound>& rebounds() const { return rebounds_; }
  const std::optional<SolidTouch>& touch() const { return touch_; }
  double lowest_gamma() const { return lowest_gamma_; }

  /// Gap, velocity and gamma at a time t between the last event and the next.
  double gap(double t) const {
    if (contact_) return 0;
    const double by_force =
        f_.impulse_integral(t) - f_.impulse_integral(from_) - (t - from_) * f_.impulse(from_);
    return gap_ + (t - from_) * velocity_ + by_force / m_;
  }
  double velocity(double t) const { return contact_ ? 0 : velocity_ + push_until(t) / m_; }
  double gamma(double t) const {
    return contact_ ? std::clamp(gamma_ + push_until(t), gamma_min_, 0.0) : 0;
  }

  /// Goes to the next event or, if there is none before the time `to`, to that time, which it
  /// returns. From the last event to `to`, f_ext must have the constant sign `sign` (1 or -1), or
  /// be 0 if `sign` is 0.
  double advance(double to, double sign) {
    assert(to > from_ && (sign == 0 || sign == 1 || sign == -1));
    return contact_ ? carry(to, sign) : fly(to);
  }

 private:
  /// Impulse of f_ext from the last event to the time t.
  double push_until(double t) const { return f_.impulse(t) - f_.impulse(from_); }

  /// advance() for a sphere in flight, whose next event is a landing.
  double fly(double to) {
    const auto falls = [&](double t) { return velocity(t) < 0; };
    // The velocity is monotone, because f_ext keeps its sign. Therefore the velocity changes its
    // sign at most once.
    const double turn =
        falls(from_) == falls(to)
            ? to
            : bisect_first_true(from_, to, [&](double t) { return falls(t) == falls(to); });
    double begin = from_;
    for (const double end : {turn, to}) {
      if (begin < end && gap(end) < 0 && falls(begin + (end - begin) / 2))
        return land(bisect_first_true(begin, end, [&](double t) { return gap(t) < 0; }));
      if (begin < end && gap(end) >= last_gap_) {
        const double t =
            bisect_first_true(begin, end, [&](double s) { return gap(s) >= last_gap_; });
        move_to(t, last_gap_, velocity(t));
        ended_ = true;
        return t;
      }
      begin = end;
    }
    move_to(to, std::max(0.0, gap(to)), velocity(to));
    return to;
  }

  /// Makes these values at the time t those of the last event.
  void move_to(double t, double gap, double velocity) {
    budget_.external_impulse += push_until(t);
    budget_.external_work += m_ / 2 * (velocity - velocity_) * (velocity + velocity_);
    from_ = t;
    gap_ = gap;
    velocity_ = velocity;
  }

  /// Computes the impact at the time t, after which the sphere is in contact, or in flight again if
  /// the solids give back more than the film takes. Returns t.
  double land(double t) {
    move_to(t, 0, velocity(t));
    const double least = std::max(0.0, -f_.value(t)) * shortest_flight_ / 2;
    const auto impact =
        impact_through_film(std::min(0.0, m_ * velocity_), gamma_min_, restitution_, least);
    add_impact(budget_, m_, velocity_, impact);
    gamma_ = impact.gamma;
    lowest_gamma_ = std::min(lowest_gamma_, impact.lowest_gamma);
    const double after = impact.momentum / m_;
    if (impact.solid_impulse > 0 && !touch_) touch_ = {t, -impact.solid_impulse / m_};
    if (restitution_ > 0 && impact.solid_impulse > 0)
      rebounds_.push_back({t, velocity_, impact.solid_impulse, after, after / -velocity_});
    velocity_ = after;
    contact_ = !(after > 0);
    return t;
  }

  /// advance() for a sphere in contact. The next event is the release, at which gamma reaches 0, or
  /// the touch of the solids, at which gamma reaches gamma_min.
  double carry(double to, double sign) {
    const double end = gamma_ + push_until(to);
    double t = to;
    if (sign > 0 && end > 0)
      t = bisect_first_true(from_, to, [&](double s) { return gamma_ + push_until(s) > 0; });
    if (sign < 0 && gamma_ > gamma_min_ && end < gamma_min_)
      t = bisect_first_true(from_, to,
                            [&](double s) { return gamma_ + push_until(s) < gamma_min_; });
    const double push = push_until(t);
    const double after = gamma(t);
    budget_.external_impulse += push;
    budget_.film_impulse += gamma_ - after;
    budget_.solid_impulse += after - gamma_ - push;
    if (gamma_ > gamma_min_ && after == gamma_min_ && !touch_)
      touch_ = {t, f_.mean(from_, t) / solid_resistance_};
    contact_ = !(sign > 0 && end > 0);
    gamma_ = after;
    from_ = t;
    return t;
  }

  double m_;
  const ExternalForce& f_;
  double gamma_min_, solid_resistance_, restitution_, shortest_flight_, last_gap_;
  bool ended_ = false;
  double from_ = 0;
  bool contact_ = false;
  double gap_, velocity_, gamma_ = 0, lowest_gamma_ = 0;
  MomentumEnergyBudget budget_;
  std::vector<Rebound> rebounds_;
  std::optional<SolidTouch> touch_;
};

}  // namespace

Trajectory simulate_viscous_contact_exact(const Motion& motion,
                                          const lubrication::LubricationForce& force) {
  const ContactModel model = viscous_contact(motion, force);
  const auto& f = motion.external_force;
  const double end = motion.end_time;
  EventDriven sphere(motion, model);

  Trajectory trajectory;
  double lowest_gamma = 0;
  const auto add_row = [&](const EventDriven& state, double t) {
    const double gamma = state.gamma(t);
    const double held = state.contact() ? -f.value(t) : 0;
    const bool by_solid = gamma == model.gamma_min && held > 0;
    lowest_gamma = std::min(lowest_gamma, gamma);
    trajectory.rows.push_back({t, std::max(0.0, state.gap(t)), state.velocity(t),
                               by_solid ? 0 : held, f.value(t), gamma, by_solid ? held : 0});
  };

  // Between two neighbouring stops f_ext is smooth and has one sign.
  auto stops = f.jumps();
  std::ranges::copy(f.sign_changes(end), std::back_inserter(stops));
  stops.push_back(end);
  std::ranges::sort(stops);
  std::erase_if(stops, [&](double t) { return t > end; });
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());

  const auto times = row_times(motion, kContactTimeStep);
  auto next_row = times.begin() + 1;
  add_row(sphere, 0);
  double now = 0;
  for (const double stop : stops) {
    const double mean = f.mean(now, stop);
    const double sign = mean > 0 ? 1 : mean < 0 ? -1 : 0;
    while (now < stop) {
      report_progress(motion, now);
      const EventDriven before = sphere;
      const double event = sphere.advance(stop, sign);
      lowest_gamma = std::min({lowest_gamma, sphere.gamma(event), sphere.lowest_gamma()});
      for (; next_row != times.end() && *next_row < event; ++next_row) add_row(before, *next_row);
      const bool at_row = next_row != times.end() && *next_row == event;
      if (at_row) ++next_row;
      if (at_row || event < stop || sphere.ended() || before.contact() != sphere.contact())
        add_row(sphere, event);
      const bool has_rebounded = sphere.rebounds().size() > before.rebounds().size();
      if ((has_rebounded || (sphere.contact() && !before.contact())) &&
          !trajectory.contact_interval)
        trajectory.contact_interval = {event, event};
      if (has_rebounded || before.contact()) (*trajectory.contact_interval)[1] = event;
      ++trajectory.steps;
      now = event;
      if (sphere.ended()) break;
    }
    if (sphere.ended()) break;
  }
  trajectory.budget = sphere.budget();
  trajectory.rebounds = sphere.rebounds();
  trajectory.solid_contact_from = sphere.touch();
  if (lowest_gamma < 0) trajectory.film_from_gamma = model.film_thickness(lowest_gamma);
  return trajectory;
}

}  // namespace viscontact::reduced_model
