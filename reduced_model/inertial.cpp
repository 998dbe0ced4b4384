#include "reduced_model/inertial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/bisection.hpp"
#include "common/error.hpp"
#include "reduced_model/cvode.hpp"

namespace viscontact {
namespace {

/// The sphere at a time of the integration.
struct Instant {
  double gap, velocity;
  double error;  // by how much the velocity may be off
  double resistance;
};

/// The velocity of a sphere that obeys (I), to more digits than (I) itself gives near contact.
class Velocity {
 public:
  /// `tolerance`: of ln q.
  Velocity(const Motion& motion, const LubricationForce& force, double momentum_at_start,
           double tolerance)
      : motion_(motion),
        force_(force),
        momentum_at_start_(momentum_at_start),
        tolerance_(tolerance) {}

  /// `force_time`: t, or just before it where f_ext jumps at t, as the velocity does not.
  Instant at(double t, double q, double force_time) const {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    const double m = motion_.mass;
    const double momentum = momentum_at_start_ + motion_.external_force.impulse(t);
    const double absorbed = force_.impulse(q);
    const double by_momentum = (momentum - absorbed) / m;
    const double resistance = force_.resistance(q);
    const double momentum_error =
        (kEpsilon * (std::abs(momentum) + std::abs(absorbed)) + tolerance_ * resistance * q) / m;
    // Beyond this the balance below has fewer digits than the momentum, whatever the tolerance.
    constexpr double kMuchInertia = 1e-2;
    if (m * std::abs(by_momentum) > kMuchInertia * resistance * q &&
        std::abs(by_momentum) > 1e3 * momentum_error)
      return {q, by_momentum, momentum_error, resistance};
    // Where inertia matters little the velocity follows the force; what remains of other times shows in the momentum.
    const double balance = motion_.external_force.value(force_time) / resistance;
    const double rate = (motion_.external_force.slope(force_time) -
                         balance * balance * force_.resistance_log_slope(q) / q) /
                        resistance;
    const double correction = -m / resistance * rate;
    const double neglected =
        std::abs(correction) * std::min(1.0, std::abs(correction) / std::abs(balance));
    if (neglected < momentum_error &&
        std::abs(balance + correction - by_momentum) < 4 * momentum_error)
      return {q, balance + correction, neglected, resistance};
    return {q, by_momentum, momentum_error, resistance};
  }

 private:
  const Motion& motion_;
  const LubricationForce& force_;
  double momentum_at_start_, tolerance_;
};

/// Of the tolerance, in flight: where errors are not damped this often within the motion.
constexpr double kFlightShare = 3e-4;
constexpr double kManyDampings = 10;

/// Of the time: what a step can still resolve.
constexpr double kTimeResolution = 1e-12;

}  // namespace

Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force) {
  const double m = motion.mass;
  const double momentum_at_start = m * motion.initial_velocity + force.impulse(motion.initial_gap);
  const double tolerance = 0.1 * motion.inertial_relative_tolerance;
  const Velocity velocity(motion, force, momentum_at_start, motion.inertial_relative_tolerance);

  StiffSystem system;
  system.dimension = 1;
  const auto momentum = [&](double t) {
    return momentum_at_start + motion.external_force.impulse(t);
  };
  const auto slope = [&](double t, double q) { return (momentum(t) - force.impulse(q)) / (m * q); };
  // The state is s = ln(q/r), not ln q: its size enters CVODE's first step and the tolerance below,
  // which must not depend on the unit of length.
  const double r = force.radius();
  const auto gap_of = [r](double s) { return r * std::exp(s); };
  const auto state_of = [r](double q) { return std::log(q / r); };
  double begin = 0;  // of the present step, or where CVODE restarts
  system.derivative = [&](double t, std::span<const double> y, std::span<double> derivative) {
    const double q = gap_of(y[0]);
    // A first step is judged by the slope at its beginning, which must not be rounding.
    derivative[0] = t == begin ? velocity.at(t, q, t).velocity / q : slope(t, q);
  };
  system.jacobian = [&](double t, std::span<const double> y, std::span<double> jacobian) {
    const double q = gap_of(y[0]);
    jacobian[0] = -force.resistance(q) / m - slope(t, q);
  };
  // s is a logarithm: its absolute error is the relative error of the gap. Where the film damps errors the tolerance bounds them; in flight they last, and a landing, where ln q
  // runs fast, makes errors of time large.
  system.tolerance = [&](double t, std::span<const double> y, std::span<double> allowed) {
    constexpr double kRounding = 4 * std::numeric_limits<double>::epsilon();
    const double q = gap_of(y[0]);
    const double damping = force.resistance(q) / m + slope(t, q);
    const double share = damping * motion.end_time > kManyDampings ? 1 : kFlightShare;
    allowed[0] = share * tolerance + kRounding * std::abs(y[0]);
  };
  const std::array start = {state_of(motion.initial_gap)};
  Cvode cvode(system, start);

  Trajectory trajectory;
  const auto times = row_times(motion);
  trajectory.rows.reserve(times.size() + 16);
  const auto add_row = [&](double t, const Instant& at) {
    trajectory.rows.push_back(
        {t, at.gap, at.velocity, -at.resistance * at.velocity, motion.external_force.value(t)});
  };
  add_row(0,
          {motion.initial_gap, motion.initial_velocity, 0, force.resistance(motion.initial_gap)});

  auto stops = motion.external_force.jumps();
  std::erase_if(stops, [&](double t) { return t >= motion.end_time; });
  stops.push_back(motion.end_time);
  // After a jump a film that damps faster than t has digits follows at once.
  const auto first_step = [&](double t) {
    const double step = kTimeResolution * t;
    return m < step * force.resistance(gap_of(cvode.state()[0])) ? step : 0;
  };
  auto next_row = times.begin() + 1;
  double given_up_at = -1;
  double last_sign = 0;  // of the velocity where it was last beyond its error
  double from = 0;       // the last jump of f_ext
  for (const double stop : stops) {
    cvode.restart(from, stop, first_step(from));
    while (begin < stop) {
      check_in(motion, begin);
      try {
        cvode.step();
      } catch (const Error&) {
        // Off the film's balance by more than its tolerance, however little that is, CVODE would have to follow how it comes back, at the rate R/m. It gets one chance
        // to begin afresh, from the balance.
        if (begin <= given_up_at) throw;
        given_up_at = begin;
        const Instant now = velocity.at(begin, gap_of(cvode.state()[0]), begin);
        if (first_step(begin) > 0)
          cvode.set_state(
              std::array{state_of(force.gap_of_impulse(momentum(begin) - m * now.velocity))});
        cvode.restart(begin, stop, first_step(begin));
        continue;
      }
      const double end = cvode.time();
      // The force has jumped at the stop already; the velocity has not.
      const auto instant_of = [&](double t, double s) {
        return velocity.at(t, gap_of(s), t == stop ? std::nextafter(stop, from) : t);
      };
      // ln q in powers of t - end; worth the making where many rows lie in the step.
      constexpr std::ptrdiff_t kManyRows = 8;
      const bool many = times.end() - next_row > kManyRows && *(next_row + kManyRows) < end;
      const std::vector<double> expansion = many ? cvode.expansion() : std::vector<double>();
      const auto log_gap_at = [&](double t) {
        if (!many) return cvode.at(t);
        double s = 0;
        for (std::size_t k = expansion.size(); k-- > 0;) s = s * (t - end) + expansion[k];
        return s;
      };
      const auto instant = [&](double t) { return instant_of(t, log_gap_at(t)); };
      const auto add_rows_before = [&](double time) {
        for (; next_row != times.end() && *next_row < time; ++next_row)
          add_row(*next_row, instant(*next_row));
      };
      const Instant now = instant_of(end, cvode.state()[0]);
      const double sign = std::abs(now.velocity) > now.error ? std::copysign(1.0, now.velocity) : 0;
      if (sign * last_sign < 0) {
        const double turn =
            beginning_of(begin, end, [&](double t) { return instant(t).velocity * sign > 0; });
        add_rows_before(turn);
        if (next_row == times.end() || *next_row != turn) add_row(turn, instant(turn));
      }
      if (sign != 0) last_sign = sign;
      add_rows_before(end);
      if (next_row != times.end() && *next_row == end) {
        add_row(end, now);
        ++next_row;
      }
      begin = end;
      // What is left of a fall is over before t has another digit: the film takes the momentum at once.
      const double q = now.gap;
      if (begin < stop && -now.velocity * kTimeResolution * end > q) {
        const double film = force.gap_of_impulse(momentum(end));
        if (film < q && m < kTimeResolution * end * force.resistance(film)) {
          cvode.set_state(std::array{state_of(film)});
          cvode.restart(end, stop, kTimeResolution * end);
        }
      }
    }
    from = stop;
  }
  trajectory.steps = cvode.steps();
  return trajectory;
}

}  // namespace viscontact
