// The models `smooth` and `rough` (docs/physics.md (4.8), (4.9)): CVODE integrates the motion from
// one change of the solid contact to the next.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>
#include <span>

#include "viscontact/common/root_finding.hpp"
#include "viscontact/lubrication/lubrication_force.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/models/inertial_equation.hpp"
#include "viscontact/rolling/rolling_resistance.hpp"

namespace viscontact::rolling {
namespace {

/// The components of the state: s = ln(q/r) [1], the velocity u - V relative to the plane [L/T], w
/// [1/T], x [L] and the angle [rad].
enum RollingState : std::size_t { kLogGap, kMove, kTurn, kPosition, kAngle, kStates };
using RollingStateVector = std::array<double, kStates>;

/// Free choices of the tolerances, which keep them > 0 for a sphere at rest and at x = 0.
struct RollingTuning {
  // Least velocity in radii per duration of the motion.
  static constexpr double kLeastMove = 1e-12;
  // Share of the longest way at that velocity that is added to the position.
  static constexpr double kOfPath = 1e-3;
};

/// What the solids of sphere and plane do at one time. The slip of the lowest point is u - V - r w.
struct SolidState {
  bool touches = false;  ///< true: the gap is constant
  /// How the solids move along each other; kNone if they do not touch.
  SolidContact contact = SolidContact::kNone;
  /// A number of any size whose sign is that of the slip while the sphere slides.
  double sliding_direction = 0;
};

/// The equations of motion (4.8) for what the solids do at present. `motion` and `fit` must outlive
/// the object.
class RollingEquation {
 public:
  /// The solids touch at the gap `contact_gap` [L]; 0: they never touch. Throws Error(kBadInput) if
  /// the sphere starts above the gaps of `fit`.
  RollingEquation(const RollingMotion& motion, const motions::PairFit& fit, double contact_gap);

  RollingStateVector initial_state() const;
  /// The gap q in the state `y` [L].
  double gap_of(std::span<const double> y) const;
  /// dq/dt [L/T] at time t.
  double normal_velocity(double t, std::span<const double> y) const;
  double contact_force() const;  ///< force of the solids along z [M L/T^2], >= 0
  /// Force of the solids along x [M L/T^2].
  double friction_force(std::span<const double> y) const;
  double slip(std::span<const double> y) const;  ///< slip of the lowest point [L/T]
  /// 1/m + r^2/I [1/M]: acceleration of the lowest point per force of friction.
  double compliance() const;
  /// True if Coulomb's friction can keep the slip at 0. If it cannot, sets the direction of
  /// sliding.
  bool can_roll(std::span<const double> y);

  /// The equations for CVODE. `step_begin`, the time at which its present step begins, is read at
  /// each call.
  reduced_model::StiffSystem system(const double& step_begin) const;

  double radius() const { return radius_; }

  /// What the solids do at present. Callers change it between two steps of CVODE.
  SolidState solids;

 private:
  /// The force [M L/T^2] and the torque [M L^2/T^2] without those of the solids.
  RollingForce free_force(std::span<const double> y) const;
  /// The rate of the slip without friction [L/T^2].
  double slip_rate(std::span<const double> y) const;
  /// Sets `f` to the derivatives by time of all components of `y` but s.
  void derivative(std::span<const double> y, std::span<double> f) const;
  /// Sets the Jacobian `j`, column by column, but for the derivative of the rate of s by s.
  void jacobian(std::span<const double> y, std::span<double> j) const;
  /// Sets the errors `allowed` in all components of `y` but s.
  void tolerance(std::span<const double> y, std::span<double> allowed) const;

  const RollingMotion& motion_;
  RollingFluid fluid_;
  double radius_, contact_gap_;
  reduced_model::Motion normal_;
  lubrication::LubricationForce squeeze_;
  reduced_model::InertialEquation gap_equation_;
};

/// The motion along z, with a constant force, for the equation of the gap.
reduced_model::Motion normal_motion(const RollingMotion& motion) {
  return {.mass = motion.mass,
          .initial_gap = motion.initial_gap,
          .initial_velocity = motion.normal_velocity,
          .end_time = motion.end_time,
          .external_force = reduced_model::ExternalForce({{motion.end_time, motion.normal_force}})};
}

/// Throws Error(kBadInput) if the sphere starts above the gaps of the fit.
RollingFluid fluid_around(const RollingMotion& motion, const motions::PairFit& fit) {
  const RollingFluid fluid(fit);
  (void)fluid.at(motion.initial_gap);
  return fluid;
}

RollingEquation::RollingEquation(const RollingMotion& motion, const motions::PairFit& fit,
                                 double contact_gap)
    : motion_(motion),
      fluid_(fluid_around(motion, fit)),
      radius_(fit.radius),
      contact_gap_(contact_gap),
      normal_(normal_motion(motion)),
      squeeze_(fit.entries.at(motions::PairEntry::kSqueeze).fit,
               {.below = lubrication::BelowInterval::kLubricationLimit}),
      gap_equation_(normal_, squeeze_, motion.relative_tolerance) {}

RollingStateVector RollingEquation::initial_state() const {
  return {gap_equation_.state_of(motion_.initial_gap), motion_.velocity - motion_.plane_velocity,
          motion_.angular_velocity, 0, 0};
}

double RollingEquation::gap_of(std::span<const double> y) const {
  return solids.touches ? contact_gap_ : gap_equation_.gap_of(y[kLogGap]);
}

double RollingEquation::normal_velocity(double t, std::span<const double> y) const {
  return solids.touches ? 0 : gap_equation_.instant(t, gap_of(y), t).velocity;
}

double RollingEquation::contact_force() const {
  return solids.touches ? std::max(0.0, -motion_.normal_force) : 0;
}

double RollingEquation::slip(std::span<const double> y) const {
  return slip_of({y[kMove], y[kTurn]}, radius_);
}

RollingForce RollingEquation::free_force(std::span<const double> y) const {
  const auto fluid = fluid_force(fluid_.at(gap_of(y)), {y[kMove], y[kTurn]});
  return {motion_.force + fluid.force, motion_.torque + fluid.torque};
}

double RollingEquation::compliance() const {
  return 1 / motion_.mass + radius_ * radius_ / motion_.moment_of_inertia;
}

double RollingEquation::slip_rate(std::span<const double> y) const {
  const auto free = free_force(y);
  return free.force / motion_.mass - radius_ * free.torque / motion_.moment_of_inertia;
}

double RollingEquation::friction_force(std::span<const double> y) const {
  switch (solids.contact) {
    case SolidContact::kRolling:
      return -slip_rate(y) / compliance();
    case SolidContact::kSliding:
      return -std::copysign(motion_.friction * contact_force(), solids.sliding_direction);
    case SolidContact::kNone:
      break;
  }
  return 0;
}

bool RollingEquation::can_roll(std::span<const double> y) {
  const auto friction = coulomb(slip_rate(y), compliance(), motion_.friction * contact_force());
  if (friction.contact == SolidContact::kRolling) return true;
  solids.sliding_direction = friction.force != 0 ? -friction.force : slip_rate(y);
  return false;
}

reduced_model::StiffSystem RollingEquation::system(const double& step_begin) const {
  const auto of_gap = gap_equation_.system(step_begin);
  reduced_model::StiffSystem system;
  system.dimension = kStates;
  system.tolerance_key = "rolling.relative_tolerance";
  system.derivative = [this, of_gap](double t, std::span<const double> y, std::span<double> f) {
    derivative(y, f);
    f[kLogGap] = 0;
    if (!solids.touches) of_gap.derivative(t, y.first(1), f.first(1));
  };
  system.jacobian = [this, of_gap](double t, std::span<const double> y, std::span<double> j) {
    jacobian(y, j);
    if (!solids.touches) of_gap.jacobian(t, y.first(1), j.first(1));
  };
  system.tolerance = [this, of_gap](double t, std::span<const double> y,
                                    std::span<double> allowed) {
    tolerance(y, allowed);
    of_gap.tolerance(t, y.first(1), allowed.first(1));
  };
  return system;
}

void RollingEquation::derivative(std::span<const double> y, std::span<double> f) const {
  const auto free = free_force(y);
  const double friction = friction_force(y);
  f[kMove] = (free.force + friction) / motion_.mass;
  f[kTurn] = (free.torque - radius_ * friction) / motion_.moment_of_inertia;
  f[kPosition] = y[kMove] + motion_.plane_velocity;
  f[kAngle] = y[kTurn];
}

void RollingEquation::jacobian(std::span<const double> y, std::span<double> j) const {
  std::ranges::fill(j, 0.0);
  const auto at = [&](std::size_t row, std::size_t column) -> double& {
    return j[column * kStates + row];
  };
  const auto put = [&](std::size_t column, const RollingForce& change) {
    // In rolling the friction takes the value that keeps the slip constant.
    double friction = 0;
    if (solids.contact == SolidContact::kRolling)
      friction =
          -(change.force / motion_.mass - radius_ * change.torque / motion_.moment_of_inertia) /
          compliance();
    at(kMove, column) = (change.force + friction) / motion_.mass;
    at(kTurn, column) = (change.torque - radius_ * friction) / motion_.moment_of_inertia;
  };
  const double gap = gap_of(y);
  const auto r = fluid_.at(gap);
  put(kMove, fluid_force(r, {1, 0}));
  put(kTurn, fluid_force(r, {0, 1}));
  if (!solids.touches) put(kLogGap, fluid_force(fluid_.slopes(gap), {y[kMove], y[kTurn]}));
  at(kPosition, kMove) = 1;
  at(kAngle, kTurn) = 1;
}

void RollingEquation::tolerance(std::span<const double> y, std::span<double> allowed) const {
  // The tolerances of the velocities are relative to the largest velocity that the forces can
  // cause, so that a velocity that passes through 0 does not stop CVODE.
  const auto r = fluid_.at(std::min(gap_of(y), fluid_.largest_gap()));
  const double move = std::abs(y[kMove]) + radius_ * std::abs(y[kTurn]) +
                      std::abs(motion_.force) / r.slide +
                      std::abs(motion_.torque) * radius_ / r.roll;
  const double scale = std::max(move, RollingTuning::kLeastMove * radius_ / motion_.end_time);
  allowed[kMove] = motion_.relative_tolerance * scale;
  allowed[kTurn] = allowed[kMove] / radius_;
  allowed[kPosition] = motion_.relative_tolerance *
                       (std::abs(y[kPosition]) + scale * motion_.end_time * RollingTuning::kOfPath);
  allowed[kAngle] = allowed[kPosition] / radius_;
}

struct LiftOff {
  double time = 0;
  RollingStateVector state{};
};

/// The motion up to its end, or until the sphere is lifted off the roughness.
class LubricatedRun {
 public:
  LubricatedRun(const RollingMotion& motion, const motions::PairFit& fit, double contact_gap,
                std::vector<double> times)
      : motion_(motion),
        contact_gap_(contact_gap),
        times_(std::move(times)),
        equation_(motion, fit, contact_gap),
        cvode_(equation_.system(now_), equation_.initial_state()) {}

  /// Computes the rows at `times`.
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
  /// Accepts the last step of CVODE, or the part of it up to the first change of the contact.
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

  /// The state at a time [T] within the last step of CVODE, or at 0.
  RollingStateVector state_at(double time) const {
    if (time == 0) return equation_.initial_state();
    RollingStateVector state{};
    for (std::size_t i = 0; i < kStates; ++i) state[i] = cvode_.at(time, i);
    return state;
  }

  /// The time from `from` to `to` [T] at which the slip becomes 0; `to` if it does not.
  double end_of_sliding(double from, double to) const {
    if (equation_.solids.contact != SolidContact::kSliding) return to;
    const auto has_stopped = [&](double t) {
      return equation_.slip(state_at(t)) * equation_.solids.sliding_direction < 0;
    };
    return has_stopped(to) ? bisect_first_true(from, to, has_stopped) : to;
  }

  /// Changes the state as the solids touch. The normal velocity becomes 0, and Coulomb's friction
  /// acts during the impact, too. A force away from the plane lifts the sphere off at once.
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

  /// Sets the slip to 0 exactly. From then on the sphere rolls if friction can prevent slip;
  /// otherwise it slides.
  void stick(RollingStateVector& state) {
    push(state, -equation_.slip(state) / equation_.compliance());
    equation_.solids.contact =
        equation_.can_roll(state) ? SolidContact::kRolling : SolidContact::kSliding;
    cvode_.set_state(state);
  }

  /// Changes the state by an impulse along x on the lowest point [M L/T].
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
  std::vector<double> times_;
  double now_ = 0;
  RollingEquation equation_;
  reduced_model::Cvode cvode_;
  RollingTrajectory rows_;
  std::optional<LiftOff> lift_off_;
};

/// Appends the motion after a lift-off. The force along z is constant and > 0, so that the sphere
/// does not come back, and the solids do not touch again.
void append_flight(const RollingMotion& motion, const motions::PairFit& fit, double contact_gap,
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

/// The motion of a sphere whose solids touch at the gap `contact_gap` [L]; 0: they never touch.
RollingTrajectory roll_with_lubrication(const RollingMotion& motion, const motions::PairFit& fit,
                                        double contact_gap) {
  assert(motion.mass > 0 && motion.moment_of_inertia > 0 && motion.initial_gap > 0);
  assert(motion.friction >= 0 && contact_gap >= 0);
  assert(motion.relative_tolerance > 0 && motion.relative_tolerance < 1);
  const int count = reduced_model::step_count(motion.end_time, motion.time_step);
  std::vector<double> times;
  for (int i = 0; i <= count; ++i)
    times.push_back(reduced_model::step_time(i, count, motion.end_time, motion.time_step));
  LubricatedRun run(motion, fit, contact_gap, times);
  auto rows = run.run();
  if (run.lift_off() && rows.size() < times.size())
    append_flight(motion, fit, contact_gap, times, *run.lift_off(), rows);
  return rows;
}

}  // namespace

RollingTrajectory roll_smooth(const RollingMotion& motion, const motions::PairFit& fit) {
  return roll_with_lubrication(motion, fit, 0);
}

RollingTrajectory roll_rough(const RollingMotion& motion, const motions::PairFit& fit) {
  return roll_with_lubrication(motion, fit, motion.roughness);
}

}  // namespace viscontact::rolling
