// CVODE integrates the motion of a sphere whose film resists (physics.md (4.8), (4.9)). Until the
// solids touch, the state is s = ln(q/r), whose equation is that of inertial_equation.hpp, then u -
// V, w, x and the angle. In contact the gap is constant.
#include <algorithm>
#include <array>
#include <cmath>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/models/inertial_equation.hpp"
#include "viscontact/reduced_model/rolling/rolling_resistance.hpp"

namespace viscontact::reduced_model {
namespace {

// Components of the state.
enum State : std::size_t { kLogGap, kMove, kTurn, kPosition, kAngle, kStates };
using StateVector = std::array<double, kStates>;

Motion normal_motion(const RollingMotion& motion) {
  return {.mass = motion.mass,
          .initial_gap = motion.initial_gap,
          .initial_velocity = motion.normal_velocity,
          .end_time = motion.end_time,
          .external_force = ExternalForce({{motion.end_time, motion.normal_force}})};
}

class LubricatedRun {
 public:
  LubricatedRun(const RollingMotion& motion, const lubrication::PairFit& fit, double contact_gap)
      : motion_(motion),
        fluid_(fit),
        radius_(fit.radius),
        contact_gap_(contact_gap),
        normal_(normal_motion(motion)),
        squeeze_(fit.entries.at(lubrication::PairEntry::kSqueeze).fit,
                 {.below = lubrication::BelowInterval::kLubricationLimit}),
        equation_(normal_, squeeze_, motion.relative_tolerance),
        normal_system_(equation_.system(now_)),
        cvode_(system(), StateVector{equation_.state_of(motion.initial_gap),
                                     motion.velocity - motion.plane_velocity,
                                     motion.angular_velocity, 0, 0}) {
    const int count = step_count(motion.end_time, motion.time_step);
    for (int i = 0; i <= count; ++i)
      times_.push_back(step_time(i, count, motion.end_time, motion.time_step));
  }

  RollingTrajectory run() {
    add_row(0, initial_state());
    next_row_ = 1;
    if (motion_.initial_gap <= contact_gap_ && motion_.normal_force < 0) touch(0, initial_state());
    cvode_.restart(0, motion_.end_time);
    while (now_ < motion_.end_time) {
      motion_.stop.throw_if_stop_requested();
      cvode_.step();
      double end = cvode_.time();
      const bool touches = !in_contact_ && gap_of(state_at(end)) <= contact_gap_;
      if (touches)
        end = bisect_first_true(now_, end,
                                [&](double t) { return gap_of(state_at(t)) <= contact_gap_; });
      const double slip_end =
          in_contact_ && contact_ == SolidContact::kSliding ? end_of_sliding(now_, end) : end;
      const bool sticks = slip_end < end;
      end = slip_end;
      for (; next_row_ < times_.size() && times_[next_row_] <= end; ++next_row_)
        add_row(times_[next_row_], state_at(times_[next_row_]));
      const auto state = state_at(end);
      now_ = end;
      if (touches) touch(end, state);
      if (sticks) stick(state);
      const bool slips = in_contact_ && contact_ == SolidContact::kRolling && !can_roll(state);
      if (slips) contact_ = SolidContact::kSliding;
      if ((touches || sticks || slips) && now_ < motion_.end_time)
        cvode_.restart(now_, motion_.end_time);
    }
    return std::move(rows_);
  }

 private:
  StateVector initial_state() const {
    StateVector state{};
    std::ranges::copy(cvode_.state(), state.begin());
    return state;
  }
  StateVector state_at(double time) const {
    StateVector state{};
    for (std::size_t i = 0; i < kStates; ++i) state[i] = cvode_.at(time, i);
    return state;
  }
  double gap_of(std::span<const double> y) const {
    return in_contact_ ? contact_gap_ : equation_.gap_of(y[kLogGap]);
  }
  double contact_force() const { return in_contact_ ? -motion_.normal_force : 0; }

  /// Force and torque without those of the solids.
  RollingForce free_force(std::span<const double> y) const {
    const auto fluid = fluid_force(fluid_.at(gap_of(y)), {y[kMove], y[kTurn]});
    return {motion_.force + fluid.force, motion_.torque + fluid.torque};
  }
  /// 1/m + r^2/I: how much a friction force accelerates the lowest point.
  double compliance() const {
    return 1 / motion_.mass + radius_ * radius_ / motion_.moment_of_inertia;
  }
  /// The rate of the slip without friction.
  double slip_rate(std::span<const double> y) const {
    const auto free = free_force(y);
    return free.force / motion_.mass - radius_ * free.torque / motion_.moment_of_inertia;
  }
  double friction_force(std::span<const double> y) const {
    const double bound = motion_.friction * contact_force();
    if (contact_ == SolidContact::kNone) return 0;
    if (contact_ == SolidContact::kRolling) return -slip_rate(y) / compliance();
    return -std::copysign(bound, sliding_direction_);
  }
  bool can_roll(std::span<const double> y) {
    const auto friction = coulomb(slip_rate(y), compliance(), motion_.friction * contact_force());
    if (friction.contact == SolidContact::kRolling) return true;
    sliding_direction_ = -friction.force;
    if (sliding_direction_ == 0) sliding_direction_ = slip_rate(y);
    return false;
  }

  /// The time in the step at which the slip becomes 0, or its end.
  double end_of_sliding(double from, double to) const {
    const auto has_stopped = [&](double t) {
      return slip_of({cvode_.at(t, kMove), cvode_.at(t, kTurn)}, radius_) * sliding_direction_ < 0;
    };
    return has_stopped(to) ? bisect_first_true(from, to, has_stopped) : to;
  }

  /// The solids touch: the normal velocity becomes 0, and friction acts during the impact, too.
  void touch(double time, StateVector state) {
    const double impulse =
        time == 0
            ? 0
            : -motion_.mass * std::min(0.0, equation_.instant(time, contact_gap_, time).velocity);
    in_contact_ = true;
    const double slip = slip_of({state[kMove], state[kTurn]}, radius_);
    const auto friction = coulomb(slip, compliance(), motion_.friction * impulse);
    state[kMove] += friction.force / motion_.mass;
    state[kTurn] -= radius_ * friction.force / motion_.moment_of_inertia;
    state[kLogGap] = equation_.state_of(contact_gap_);
    contact_ = friction.contact;
    sliding_direction_ = slip;
    if (contact_ == SolidContact::kRolling)
      stick(state);
    else
      cvode_.set_state(state);
  }

  /// Sets the slip to 0 exactly, and rolls on if friction suffices.
  void stick(StateVector state) {
    const double impulse = -slip_of({state[kMove], state[kTurn]}, radius_) / compliance();
    state[kMove] += impulse / motion_.mass;
    state[kTurn] -= radius_ * impulse / motion_.moment_of_inertia;
    contact_ = can_roll(state) ? SolidContact::kRolling : SolidContact::kSliding;
    cvode_.set_state(state);
  }

  StiffSystem system() {
    StiffSystem system;
    system.dimension = kStates;
    system.derivative = [this](double t, std::span<const double> y, std::span<double> f) {
      derivative(t, y, f);
    };
    system.jacobian = [this](double t, std::span<const double> y, std::span<double> j) {
      jacobian(t, y, j);
    };
    system.tolerance = [this](double t, std::span<const double> y, std::span<double> allowed) {
      normal_system_.tolerance(t, y.first(1), allowed.first(1));
      // Velocities to the tolerance of the largest one that the forces can make, so that one that
      // passes through 0 does not stop CVODE.
      const auto r = fluid_.at(std::min(gap_of(y), fluid_.largest_gap()));
      const double move = std::abs(y[kMove]) + radius_ * std::abs(y[kTurn]) +
                          std::abs(motion_.force) / r.slide +
                          std::abs(motion_.torque) * radius_ / r.roll;
      const double scale = std::max(move, 1e-12 * radius_ / motion_.end_time);
      allowed[kMove] = motion_.relative_tolerance * scale;
      allowed[kTurn] = allowed[kMove] / radius_;
      allowed[kPosition] =
          motion_.relative_tolerance * (std::abs(y[kPosition]) + scale * motion_.end_time * 1e-3);
      allowed[kAngle] = allowed[kPosition] / radius_;
    };
    return system;
  }

  void derivative(double t, std::span<const double> y, std::span<double> f) const {
    f[kLogGap] = 0;
    if (!in_contact_) normal_system_.derivative(t, y.first(1), f.first(1));
    const auto free = free_force(y);
    const double friction = friction_force(y);
    f[kMove] = (free.force + friction) / motion_.mass;
    f[kTurn] = (free.torque - radius_ * friction) / motion_.moment_of_inertia;
    f[kPosition] = y[kMove] + motion_.plane_velocity;
    f[kAngle] = y[kTurn];
  }

  void jacobian(double t, std::span<const double> y, std::span<double> j) const {
    std::ranges::fill(j, 0.0);
    const auto at = [&](std::size_t row, std::size_t column) -> double& {
      return j[column * kStates + row];
    };
    if (!in_contact_) {
      std::array<double, 1> of_gap{};
      normal_system_.jacobian(t, y.first(1), of_gap);
      at(kLogGap, kLogGap) = of_gap[0];
    }
    const double gap = gap_of(y);
    const auto put = [&](std::size_t column, const RollingForce& change) {
      // Friction of rolling keeps the slip constant, whatever the other forces are.
      double friction = 0;
      if (contact_ == SolidContact::kRolling)
        friction =
            -(change.force / motion_.mass - radius_ * change.torque / motion_.moment_of_inertia) /
            compliance();
      at(kMove, column) = (change.force + friction) / motion_.mass;
      at(kTurn, column) = (change.torque - radius_ * friction) / motion_.moment_of_inertia;
    };
    const auto r = fluid_.at(gap);
    put(kMove, fluid_force(r, {1, 0}));
    put(kTurn, fluid_force(r, {0, 1}));
    if (!in_contact_) put(kLogGap, fluid_force(fluid_.slopes(gap), {y[kMove], y[kTurn]}));
    at(kPosition, kMove) = 1;
    at(kAngle, kTurn) = 1;
  }

  void add_row(double time, const StateVector& y) {
    RollingRow row;
    row.time = time;
    row.gap = gap_of(y);
    row.position = y[kPosition];
    row.angle = y[kAngle];
    row.normal_velocity = in_contact_ ? 0 : equation_.instant(time, row.gap, time).velocity;
    row.velocity = y[kMove] + motion_.plane_velocity;
    row.angular_velocity = y[kTurn];
    row.contact_force = contact_force();
    row.friction_force = friction_force(y);
    row.contact = contact_;
    rows_.push_back(row);
  }

  const RollingMotion& motion_;
  RollingFluid fluid_;
  double radius_, contact_gap_;
  Motion normal_;
  lubrication::LubricationForce squeeze_;
  InertialEquation equation_;
  double now_ = 0;
  StiffSystem normal_system_;
  Cvode cvode_;
  bool in_contact_ = false;
  SolidContact contact_ = SolidContact::kNone;
  double sliding_direction_ = 0;  // sign of the slip while sliding
  std::vector<double> times_;
  std::size_t next_row_ = 0;
  RollingTrajectory rows_;
};

}  // namespace

RollingTrajectory roll_smooth(const RollingMotion& motion, const lubrication::PairFit& fit) {
  return LubricatedRun(motion, fit, 0).run();
}

RollingTrajectory roll_rough(const RollingMotion& motion, const lubrication::PairFit& fit) {
  return LubricatedRun(motion, fit, motion.roughness).run();
}

}  // namespace viscontact::reduced_model
