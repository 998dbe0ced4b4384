// CVODE restarts where the external force jumps; rows are made at the required times and where the
// velocity changes its sign. The symbols are those of inertial_equation.hpp.
#include "viscontact/reduced_model/models/inertial.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "viscontact/common/error.hpp"
#include "viscontact/common/root_finding.hpp"
#include "viscontact/reduced_model/external_force/polynomial.hpp"
#include "viscontact/reduced_model/integration/cvode.hpp"
#include "viscontact/reduced_model/models/contact/rebound.hpp"
#include "viscontact/reduced_model/models/inertial_equation.hpp"

namespace viscontact::reduced_model {
namespace {

/// One integration from the start of the motion to its end.
class InertialRun {
 public:
  /// The solids touch at the gap `solid_gap` >= 0 [L], and never if it is 0. `motion` and `force`
  /// must outlive this object.
  InertialRun(const Motion& motion, const lubrication::LubricationForce& force, double solid_gap)
      : motion_(motion),
        force_(force),
        solid_gap_(solid_gap),
        equation_(motion, force, motion.parameter(kRelativeTolerance)),
        cvode_(equation_.system(now_), std::array{equation_.state_of(motion.initial_gap)}),
        times_(row_times(motion)),
        next_row_(times_.begin() + 1) {
    // Memory for 16 more rows is for the times at which the velocity changes its sign.
    trajectory_.rows.reserve(times_.size() + 16);
    add_row(0,
            {motion.initial_gap, motion.initial_velocity, 0, force.resistance(motion.initial_gap)});
  }

  /// Integrates to the end of the motion; may be called once only.
  Trajectory run() {
    assert(trajectory_.rows.size() == 1);
    auto stops = motion_.external_force.jumps();
    // There the force may pull the sphere off the solids.
    if (solid_gap_ > 0) {
      std::ranges::copy(motion_.external_force.sign_changes(motion_.end_time),
                        std::back_inserter(stops));
      std::ranges::sort(stops);
      stops.erase(std::unique(stops.begin(), stops.end(), are_one_time), stops.end());
    }
    std::erase_if(stops, [&](double t) {
      return t >= motion_.end_time || are_one_time(t, motion_.end_time);
    });
    stops.push_back(motion_.end_time);
    for (const double stop : stops) {
      stop_ = stop;
      if (rests_ && !leaves_solids()) {
        rest_until(stop);
        continue;
      }
      restart(equation_.first_step(last_stop_, gap()));
      while (now_ < stop_) {
        report_progress(motion_, now_);
        if (!step()) continue;
        if (equation_.gap_of(cvode_.state()[0]) >= last_gap_) {
          end_at_wall();
          break;
        }
        const auto now = instant_of(cvode_.time(), cvode_.state()[0]);
        if (now.gap >= solid_gap_) look_at_approach(now);
        if (now.gap < solid_gap_) {
          const double impact = bisect_first_true(now_, cvode_.time(), [&](double t) {
            return equation_.gap_of(cvode_.at(t)) < solid_gap_;
          });
          add_rows_of_step(impact, equation_.instant(impact, solid_gap_, impact));
          now_ = impact;
          collide_with_solids();
          continue;
        }
        add_rows_of_step(cvode_.time(), now);
        now_ = cvode_.time();
        double film = 0;
        if (now_ < stop_ && equation_.lands_at_once(now_, now, film)) {
          if (film < solid_gap_) {
            collide_with_solids();
            continue;
          }
          cvode_.set_state(std::array{equation_.state_of(film)});
          restart(InertialTuning::kTimeResolution * now_);
        }
      }
      if (ended_) break;
      last_stop_ = stop_;
    }
    trajectory_.steps = cvode_.steps();
    if (solid_gap_ > 0) trajectory_.budget = budget();
    return std::move(trajectory_);
  }

 private:
  double gap() const { return equation_.gap_of(cvode_.state()[0]); }

  void restart(double first_step) { cvode_.restart(now_, stop_, first_step); }

  /// Then restarts CVODE, or lets the sphere rest until the next stop.
  void collide_with_solids() {
    const double before = std::min(0.0, velocity_at_solids()), m = motion_.mass;
    if (!trajectory_.solid_contact_from)
      trajectory_.solid_contact_from = {
          now_, std::min(0.0, equation_.instant(now_, solid_gap_, now_).velocity)};
    const double restitution = motion_.restitution();
    double after = -restitution * before;
    const double pull = motion_.external_force.value(now_);
    rests_ = !(after > 0) || (pull < 0 && 2 * m * after < -pull * BounceTuning::kShortestOfMotion *
                                                              motion_.end_time);
    if (rests_) after = 0;
    equation_.add_impulse(m * (after - velocity_at_solids()));
    solid_impulse_ += m * (after - before);
    solid_work_ += m / 2 * (after - before) * (after + before);
    if (before < 0) add_rebound(before, after);
    cvode_.set_state(std::array{equation_.state_of(solid_gap_)});
    if (rests_ && !leaves_solids())
      rest_until(stop_);
    else
      restart(0);
  }

  /// Records an impact at the time now_, with the velocities `before` < 0 and `after` >= 0 at the
  /// solids, as simulate_inertial_rough() says.
  void add_rebound(double before, double after) {
    look_at_approach({solid_gap_, before, 0, 0});
    const double drag = (force_.impulse(fastest_.gap) - force_.impulse(solid_gap_)) / motion_.mass;
    const double approach = fastest_.velocity, leaving = std::max(0.0, after - drag);
    if (leaving > 0 || !has_impact_)
      trajectory_.rebounds.push_back(
          {now_, approach, -motion_.mass * before, leaving, leaving / -approach});
    has_impact_ = !(leaving > 0);
    if (leaving > 0) fastest_ = {solid_gap_, 0, 0, 0};
  }

  void look_at_approach(const InertialInstant& at) {
    if (at.velocity < fastest_.velocity) fastest_ = at;
  }

  /// Ends the motion in the last step of CVODE, when the sphere reaches the wall opposite.
  void end_at_wall() {
    const double end = bisect_first_true(
        now_, cvode_.time(), [&](double t) { return equation_.gap_of(cvode_.at(t)) >= last_gap_; });
    const auto at_wall = equation_.instant(end, last_gap_, end);
    add_rows_of_step(end, at_wall);
    if (trajectory_.rows.back().time < end) add_row(end, at_wall);
    now_ = end;
    ended_ = true;
  }

  double velocity_at_solids() const {
    return (equation_.momentum(now_) - force_.impulse(solid_gap_)) / motion_.mass;
  }

  /// The force has one sign until the next stop; if it is a pull, the sphere no longer rests.
  bool leaves_solids() {
    if (!(motion_.external_force.mean(now_, stop_) > 0)) return false;
    rests_ = false;
    return true;
  }

  /// The sphere rests on the solids until the time `stop`, and the solids carry the external force.
  void rest_until(double stop) {
    const double solid_load =
        motion_.external_force.impulse(stop) - motion_.external_force.impulse(now_);
    equation_.add_impulse(-solid_load);
    solid_impulse_ -= solid_load;
    for (; next_row_ != times_.end() && *next_row_ <= stop; ++next_row_) {
      const double f = motion_.external_force.value(*next_row_);
      trajectory_.rows.push_back({*next_row_, solid_gap_, 0, 0.0, f, {}, -f});
    }
    now_ = last_stop_ = stop;
  }

  /// The work of the external force is the sum over the rows of the mean force times the change of
  /// the gap; that of the film is chosen so that the energy is balanced.
  MomentumEnergyBudget budget() const {
    MomentumEnergyBudget budget;
    const auto& rows = trajectory_.rows;
    for (std::size_t i = 1; i < rows.size(); ++i)
      budget.external_work += motion_.external_force.mean(rows[i - 1].time, rows[i].time) *
                              (rows[i].gap - rows[i - 1].gap);
    const double first = rows.front().velocity, last = rows.back().velocity, m = motion_.mass;
    budget.external_impulse = motion_.external_force.impulse(rows.back().time);
    budget.solid_impulse = solid_impulse_;
    budget.solid_work = solid_work_;
    budget.film_impulse = m * (last - first) - budget.external_impulse - solid_impulse_;
    budget.film_work = m / 2 * (last - first) * (last + first) - budget.external_work - solid_work_;
    return budget;
  }

  /// Returns false if the step failed and CVODE was restarted.
  bool step() {
    try {
      cvode_.step();
      return true;
    } catch (const Error&) {
      // CVODE can fail where it must resolve how the velocity returns to the balance of drag and
      // force, at the rate R/m. Then CVODE is restarted from the balanced state. If it fails again
      // at the same time, the Error is thrown.
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
    // At the stop time the external force has jumped, but the velocity has not. Therefore the force
    // is taken just before this time.
    const double force_time = t == stop_ ? std::nextafter(stop_, last_stop_) : t;
    return equation_.instant(t, equation_.gap_of(s), force_time);
  }

  /// Until the time `end` in the last step of CVODE, at which the state is `now`. If the velocity
  /// changes its sign, there is a row at the time of the change.
  void add_rows_of_step(double end, const InertialInstant& now) {
    constexpr auto kManyRows = InertialTuning::kManyRows;
    const bool many = times_.end() - next_row_ > kManyRows && *(next_row_ + kManyRows) < end;
    const std::vector<double> expansion = many ? cvode_.expansion() : std::vector<double>();
    const auto instant = [&](double t) {
      if (!many) return instant_of(t, cvode_.at(t));
      return instant_of(t, polynomial::value(expansion, t - cvode_.time()));
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
  const lubrication::LubricationForce& force_;
  double solid_gap_;
  double last_gap_ = motion_ends_at(force_.largest_gap());
  bool ended_ = false;  // true after the sphere has reached the wall opposite
  // The state of fastest approach since the last rebound.
  InertialInstant fastest_{motion_.initial_gap, std::min(0.0, motion_.initial_velocity), 0, 0};
  bool has_impact_ = false;                    // an impact since then is recorded
  double solid_impulse_ = 0, solid_work_ = 0;  // of the solids on the sphere
  bool rests_ = false;                         // true while the sphere rests on the solids
  InertialEquation equation_;
  double now_ = 0;  // end of the last step, or time of the restart
  Cvode cvode_;
  double stop_ = 0, last_stop_ = 0;  // next and last time at which CVODE must stop
  double given_up_at_ = -1;          // time at which CVODE failed last; -1: it never did
  // Sign of the velocity when it was last larger than its error.
  double last_sign_ = 0;
  std::vector<double> times_;
  std::vector<double>::const_iterator next_row_;
  Trajectory trajectory_;
};

}  // namespace

Trajectory simulate_inertial(const Motion& motion, const lubrication::LubricationForce& force) {
  return InertialRun(motion, force, 0).run();
}

void check_start_outside_roughness(const Motion& motion) {
  const double solid_gap = motion.roughness[0] + motion.roughness[1];
  if (!(motion.initial_gap > solid_gap))
    throw Error(
        ErrorKind::kBadInput,
        "motion.initial_gap is {}; it must be greater than the roughness heights together, {}",
        motion.initial_gap, solid_gap);
}

Trajectory simulate_inertial_rough(const Motion& motion,
                                   const lubrication::LubricationForce& force) {
  check_start_outside_roughness(motion);
  return InertialRun(motion, force, motion.roughness[0] + motion.roughness[1]).run();
}

}  // namespace viscontact::reduced_model
