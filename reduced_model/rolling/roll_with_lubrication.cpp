// CVODE integrates the motion of a sphere whose film resists, from one change of the solid contact
// to the next: the sphere touches the roughness, its slip ends, friction no longer suffices, or it
// is lifted off.
#include <algorithm>
#include <cmath>
#include <optional>

#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/rolling/rolling_equation.hpp"

namespace viscontact::reduced_model {
namespace {

/// The state in which a sphere leaves the roughness.
struct LiftOff {
  double time = 0;
  RollingStateVector state{};
};

/// The motion up to its end, or until the sphere is lifted off the roughness.
class LubricatedRun {
 public:
  LubricatedRun(const RollingMotion& motion, const lubrication::PairFit& fit, double contact_gap,
                std::vector<double> times)
      : motion_(motion),
        contact_gap_(contact_gap),
        times_(std::move(times)),
        equation_(motion, fit, contact_gap),
        cvode_(equation_.system(now_), equation_.initial_state()) {}

  /// The rows at the times, as far as the sphere is not lifted off before.
  RollingTrajectory run() {
    add_rows_until(0);
    const bool starts_in_contact = motion_.initial_gap <= contact_gap_ &&
                                   motion_.normal_velocity <= 0 && motion_.normal_force < 0;
    if (starts_in_contact) {
      auto state = equation_.initial_state();
      touch(state);
    }
    cvode_.restart(0, motion_.end_time);
    while (now_ < motion_.end_time && !lift_off_) {
      motion_.stop.throw_if_stop_requested();
      cvode_.step();
      advance();
    }
    return std::move(rows_);
  }

  const std::optional<LiftOff>& lift_off() const { return lift_off_; }

 private:
  /// Takes the step of CVODE, or its part up to the first change of the contact.
  void advance() {
    double end = cvode_.time();
    const bool touches =
        !equation_.solids.touches && equation_.gap_of(state_at(end)) <= contact_gap_;
    if (touches)
      end = bisect_first_true(
          now_, end, [&](double t) { return equation_.gap_of(state_at(t)) <= contact_gap_; });
    const double slip_end = end_of_sliding(now_, end);
    const bool sticks = slip_end < end;
    end = slip_end;
    add_rows_until(end);
    auto state = state_at(end);
    now_ = end;
    if (touches) touch(state);
    if (sticks) stick(state);
    auto& contact = equation_.solids.contact;
    const bool slips =
        !touches && !sticks && contact == SolidContact::kRolling && !equation_.can_roll(state);
    if (slips) contact = SolidContact::kSliding;
    if ((touches || sticks || slips) && now_ < motion_.end_time)
      cvode_.restart(now_, motion_.end_time);
  }

  RollingStateVector state_at(double time) const {
    if (time == 0) return equation_.initial_state();
    RollingStateVector state{};
    for (std::size_t i = 0; i < kStates; ++i) state[i] = cvode_.at(time, i);
    return state;
  }

  /// The time in the step at which the slip becomes 0, or its end.
  double end_of_sliding(double from, double to) const {
    if (equation_.solids.contact != SolidContact::kSliding) return to;
    const auto has_stopped = [&](double t) {
      return equation_.slip(state_at(t)) * equation_.solids.sliding_direction < 0;
    };
    return has_stopped(to) ? bisect_first_true(from, to, has_stopped) : to;
  }

  /// The solids touch: the normal velocity becomes 0, and friction acts during the impact, too.
  void touch(RollingStateVector& state) {
    const double impulse = -motion_.mass * std::min(0.0, equation_.normal_velocity(now_, state));
    const double slip = equation_.slip(state);
    const auto friction = coulomb(slip, equation_.compliance(), motion_.friction * impulse);
    push(state, friction.force);
    equation_.solids = {true, friction.contact, slip};
    if (friction.contact == SolidContact::kRolling)
      stick(state);
    else
      cvode_.set_state(state);
    if (motion_.normal_force > 0) lift_off_ = {now_, state};
  }

  /// Sets the slip to 0 exactly, and rolls on if friction suffices.
  void stick(RollingStateVector& state) {
    push(state, -equation_.slip(state) / equation_.compliance());
    equation_.solids.contact =
        equation_.can_roll(state) ? SolidContact::kRolling : SolidContact::kSliding;
    cvode_.set_state(state);
  }

  /// An impulse along x on the lowest point.
  void push(RollingStateVector& state, double impulse) const {
    state[kMove] += impulse / motion_.mass;
    state[kTurn] -= equation_.radius() * impulse / motion_.moment_of_inertia;
  }

  void add_rows_until(double time) {
    for (; rows_.size() < times_.size() && times_[rows_.size()] <= time;)
      add_row(times_[rows_.size()], state_at(times_[rows_.size()]));
  }

  void add_row(double time, const RollingStateVector& y) {
    rows_.push_back({.time = time,
                     .gap = equation_.gap_of(y),
                     .position = y[kPosition],
                     .angle = y[kAngle],
                     .normal_velocity = equation_.normal_velocity(time, y),
                     .velocity = y[kMove] + motion_.plane_velocity,
                     .angular_velocity = y[kTurn],
                     .contact_force = equation_.contact_force(),
                     .friction_force = equation_.friction_force(y),
                     .contact = equation_.solids.contact});
  }

  const RollingMotion& motion_;
  double contact_gap_;
  std::vector<double> times_;  // of the rows
  double now_ = 0;
  RollingEquation equation_;
  Cvode cvode_;
  RollingTrajectory rows_;
  std::optional<LiftOff> lift_off_;
};

/// Appends the motion after a lift-off. The force is constant, so that the sphere does not come
/// back, and the solids do not touch again.
void append_flight(const RollingMotion& motion, const lubrication::PairFit& fit, double contact_gap,
                   std::vector<double> times, const LiftOff& lift_off, RollingTrajectory& rows) {
  auto flight = motion;
  flight.initial_gap = contact_gap;
  flight.normal_velocity = 0;
  flight.velocity = lift_off.state[kMove] + motion.plane_velocity;
  flight.angular_velocity = lift_off.state[kTurn];
  flight.end_time = motion.end_time - lift_off.time;
  times.erase(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rows.size()));
  auto since = times;
  for (double& time : since) time -= lift_off.time;
  auto later = LubricatedRun(flight, fit, 0, since).run();
  for (std::size_t i = 0; i < later.size(); ++i) {
    later[i].time = times[i];
    later[i].position += lift_off.state[kPosition];
    later[i].angle += lift_off.state[kAngle];
  }
  rows.insert(rows.end(), later.begin(), later.end());
}

RollingTrajectory roll_with_lubrication(const RollingMotion& motion,
                                        const lubrication::PairFit& fit, double contact_gap) {
  const int count = step_count(motion.end_time, motion.time_step);
  std::vector<double> times;
  for (int i = 0; i <= count; ++i)
    times.push_back(step_time(i, count, motion.end_time, motion.time_step));
  LubricatedRun run(motion, fit, contact_gap, times);
  auto rows = run.run();
  if (run.lift_off() && rows.size() < times.size())
    append_flight(motion, fit, contact_gap, times, *run.lift_off(), rows);
  return rows;
}

}  // namespace

RollingTrajectory roll_smooth(const RollingMotion& motion, const lubrication::PairFit& fit) {
  return roll_with_lubrication(motion, fit, 0);
}

RollingTrajectory roll_rough(const RollingMotion& motion, const lubrication::PairFit& fit) {
  return roll_with_lubrication(motion, fit, motion.roughness);
}

}  // namespace viscontact::reduced_model
