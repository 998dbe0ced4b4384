// Drives CVODE through the equation of inertial_equation.hpp: it restarts where the force jumps,
// and makes rows at the required times and where the velocity changes its sign. A change of its
// results must raise kModelsRevision.
#include "viscontact/reduced_model/models/inertial.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/external_force/polynomial.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/models/inertial_equation.hpp"

namespace viscontact::reduced_model {
namespace {

/// One integration from the start of the motion to its end.
class InertialRun {
 public:
  InertialRun(const Motion& motion, const lubrication::LubricationForce& force)
      : motion_(motion),
        equation_(motion, force, motion.parameter(kRelativeTolerance)),
        cvode_(equation_.system(now_), std::array{equation_.state_of(motion.initial_gap)}),
        times_(row_times(motion)),
        next_row_(times_.begin() + 1) {
    // The 16 additional rows are for the times at which the velocity changes its sign.
    trajectory_.rows.reserve(times_.size() + 16);
    add_row(0,
            {motion.initial_gap, motion.initial_velocity, 0, force.resistance(motion.initial_gap)});
  }

  Trajectory run() {
    auto stops = motion_.external_force.jumps();
    std::erase_if(stops, [&](double t) {
      return t >= motion_.end_time || are_one_time(t, motion_.end_time);
    });
    stops.push_back(motion_.end_time);
    for (const double stop : stops) {
      stop_ = stop;
      restart(equation_.first_step(last_stop_, gap()));
      while (now_ < stop_) {
        report_progress(motion_, now_);
        if (!step()) continue;
        const auto now = instant_of(cvode_.time(), cvode_.state()[0]);
        add_rows_of_step(now);
        now_ = cvode_.time();
        double film = 0;
        if (now_ < stop_ && equation_.lands_at_once(now_, now, film)) {
          cvode_.set_state(std::array{equation_.state_of(film)});
          restart(InertialEquation::kTimeResolution * now_);
        }
      }
      last_stop_ = stop_;
    }
    trajectory_.steps = cvode_.steps();
    return std::move(trajectory_);
  }

 private:
  double gap() const { return equation_.gap_of(cvode_.state()[0]); }

  void restart(double first_step) { cvode_.restart(now_, stop_, first_step); }

  /// Makes one step of CVODE. Returns false if the step failed and CVODE was restarted.
  bool step() {
    try {
      cvode_.step();
      return true;
    } catch (const Error&) {
      // If the state differs from the balance of forces in the film by more than its tolerance,
      // CVODE would have to resolve its return to the balance, at the rate R/m. At each time CVODE
      // may restart from the balance once.
      if (now_ <= given_up_at_) throw;
      given_up_at_ = now_;
      const double q = gap();
      if (equation_.first_step(now_, q) > 0)
        cvode_.set_state(std::array{equation_.balanced_state(now_, q)});
      restart(equation_.first_step(now_, gap()));
      return false;
    }
  }

  InertialInstant instant_of(double t, double s) const {
    // At the stop time the force has jumped, but the velocity has not.
    const double force_time = t == stop_ ? std::nextafter(stop_, last_stop_) : t;
    return equation_.instant(t, equation_.gap_of(s), force_time);
  }

  /// Adds the rows within the step that has just been made, whose end is `now`.
  void add_rows_of_step(const InertialInstant& now) {
    const double end = cvode_.time();
    // If many rows are in the step, an expansion of s in powers of t - end is cheaper than at().
    constexpr std::ptrdiff_t kManyRows = 8;
    const bool many = times_.end() - next_row_ > kManyRows && *(next_row_ + kManyRows) < end;
    const std::vector<double> expansion = many ? cvode_.expansion() : std::vector<double>();
    const auto instant = [&](double t) {
      if (!many) return instant_of(t, cvode_.at(t));
      return instant_of(t, polynomial::value(expansion, t - end));
    };
    const auto add_rows_before = [&](double time) {
      for (; next_row_ != times_.end() && *next_row_ < time; ++next_row_)
        add_row(*next_row_, instant(*next_row_));
    };
    const double sign =
        std::abs(now.velocity) > now.velocity_error ? std::copysign(1.0, now.velocity) : 0;
    if (sign * last_sign_ < 0) {
      const double turn =
          bisect_first_true(now_, end, [&](double t) { return instant(t).velocity * sign > 0; });
      add_rows_before(turn);
      if (next_row_ == times_.end() || *next_row_ != turn) add_row(turn, instant(turn));
    }
    if (sign != 0) last_sign_ = sign;
    add_rows_before(end);
    if (next_row_ != times_.end() && *next_row_ == end) {
      add_row(end, now);
      ++next_row_;
    }
  }

  void add_row(double t, const InertialInstant& at) {
    trajectory_.rows.push_back(
        {t, at.gap, at.velocity, -at.resistance * at.velocity, motion_.external_force.value(t)});
  }

  const Motion& motion_;
  InertialEquation equation_;
  double now_ = 0;  // end of the last step, or time of the restart
  Cvode cvode_;
  double stop_ = 0, last_stop_ = 0;  // next and last jump of f_ext
  double given_up_at_ = -1;          // time at which CVODE failed last; -1: it never did
  // Sign of the velocity when it was last larger than its error.
  double last_sign_ = 0;
  std::vector<double> times_;
  std::vector<double>::const_iterator next_row_;
  Trajectory trajectory_;
};

}  // namespace

Trajectory simulate_inertial(const Motion& motion, const lubrication::LubricationForce& force) {
  return InertialRun(motion, force).run();
}

}  // namespace viscontact::reduced_model
