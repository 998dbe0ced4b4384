// Equation (S), the tolerances of its integration, and the velocity that belongs to a state.
#include "viscontact/reduced_model/models/inertial_equation.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

namespace viscontact::reduced_model {

InertialEquation::InertialEquation(const Motion& motion, const lubrication::LubricationForce& force,
                                   double relative_tolerance)
    : motion_(motion),
      force_(force),
      relative_tolerance_(relative_tolerance),
      momentum_at_start_(motion.mass * motion.initial_velocity +
                         force.impulse(motion.initial_gap)) {
  assert(motion.mass > 0 && relative_tolerance > 0);
}

double InertialEquation::gap_of(double s) const {
  return std::min(force_.radius() * std::exp(s), std::nextafter(force_.largest_gap(), 0.0));
}

double InertialEquation::state_of(double gap) const { return std::log(gap / force_.radius()); }

double InertialEquation::momentum(double t) const {
  return momentum_at_start_ + motion_.external_force.impulse(t);
}

double InertialEquation::slope(double t, double gap) const {
  return (momentum(t) - force_.impulse(gap)) / (motion_.mass * gap);
}

StiffSystem InertialEquation::system(const double& step_begin) const {
  StiffSystem system;
  system.dimension = 1;
  system.derivative = [this, &step_begin](double t, std::span<const double> y,
                                          std::span<double> derivative) {
    const double q = gap_of(y[0]);
    // CVODE chooses the first step after a restart from this slope. slope() can be a rounding error
    // divided by a small mass; instant() avoids this error.
    derivative[0] = t == step_begin ? instant(t, q, t).velocity / q : slope(t, q);
  };
  system.jacobian = [this](double t, std::span<const double> y, std::span<double> jacobian) {
    const double q = gap_of(y[0]);
    jacobian[0] = -force_.resistance(q) / motion_.mass - slope(t, q);
  };
  // s is a logarithm, so that its absolute error is the relative error of the gap.
  system.tolerance = [this](double t, std::span<const double> y, std::span<double> allowed) {
    const double q = gap_of(y[0]);
    const double damping = force_.resistance(q) / motion_.mass + slope(t, q);
    const double share = damping * motion_.end_time > InertialTuning::kManyDampings
                             ? 1
                             : InertialTuning::kFlightShare;
    allowed[0] = share * (InertialTuning::kShare * relative_tolerance_) +
                 InertialTuning::kRounding * std::abs(y[0]);
  };
  return system;
}

InertialInstant InertialEquation::instant(double t, double gap, double force_time) const {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  const double m = motion_.mass, q = gap;
  const double absorbed = force_.impulse(q);
  const double by_momentum = (momentum(t) - absorbed) / m;
  const double resistance = force_.resistance(q);
  const double momentum_error = (kEpsilon * (std::abs(momentum(t)) + std::abs(absorbed)) +
                                 relative_tolerance_ * resistance * q) /
                                m;
  if (m * std::abs(by_momentum) > InertialTuning::kMuchInertia * resistance * q &&
      std::abs(by_momentum) > InertialTuning::kExactMomentum * momentum_error)
    return {q, by_momentum, momentum_error, resistance};
  // With little inertia the velocity follows from the balance of drag and force. The rest of an
  // earlier velocity is missing in this balance, but not in the velocity from the momentum.
  // Therefore both values are compared.
  const double balance = motion_.external_force.value(force_time) / resistance;
  const double rate = (motion_.external_force.slope(force_time) -
                       balance * balance * force_.resistance_log_slope(q) / q) /
                      resistance;
  const double correction = -m / resistance * rate;
  const double neglected =
      std::abs(correction) * std::min(1.0, std::abs(correction) / std::abs(balance));
  if (neglected < momentum_error &&
      std::abs(balance + correction - by_momentum) < InertialTuning::kAgreement * momentum_error)
    return {q, balance + correction, neglected, resistance};
  return {q, by_momentum, momentum_error, resistance};
}

double InertialEquation::first_step(double t, double gap) const {
  const double step = InertialTuning::kTimeResolution * t;
  return motion_.mass < step * force_.resistance(gap) ? step : 0;
}

double InertialEquation::balanced_state(double t, double gap) const {
  const double inertia = motion_.mass * instant(t, gap, t).velocity;
  return state_of(force_.gap_of_impulse(momentum(t) - inertia));
}

bool InertialEquation::lands_at_once(double t, const InertialInstant& now, double& film) const {
  if (!(-now.velocity * InertialTuning::kTimeResolution * t > now.gap)) return false;
  film = force_.gap_of_impulse(momentum(t));
  return film < now.gap &&
         motion_.mass < InertialTuning::kTimeResolution * t * force_.resistance(film);
}

}  // namespace viscontact::reduced_model
