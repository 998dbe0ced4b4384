#include "reduced_model/inertial.hpp"

#include <array>
#include <cmath>

#include "reduced_model/cvode.hpp"

namespace viscontact {

Trajectory simulate_inertial(const Motion& motion, const LubricationForce& force) {
  const double m = motion.mass;
  double f = 0;  // f_ext between the present jump and the next

  StiffSystem system;
  system.dimension = 2;
  system.derivative = [&](double, std::span<const double> y, std::span<double> derivative) {
    const double w = y[1];
    const double q = std::exp(y[0]);
    derivative[0] = w;
    derivative[1] = f / (m * q) - force.resistance(q) * w / m - w * w;
  };
  system.jacobian = [&](double, std::span<const double> y, std::span<double> jacobian) {
    const double w = y[1];
    const double q = std::exp(y[0]);
    jacobian[0] = 0;
    jacobian[1] = -f / (m * q) - force.resistance_log_slope(q) * w / m;
    jacobian[2] = 1;
    jacobian[3] = -force.resistance(q) / m - 2 * w;
  };
  system.event = [](std::span<const double> y) { return y[1]; };

  // (I): m u + Gamma(q) = P(t). The film forgets nothing, so neither may the integration: without
  // this, errors of w add up in s.
  const double momentum_at_start = m * motion.initial_velocity + force.impulse(motion.initial_gap);
  system.invariant = [&, momentum_at_start](double t, std::span<const double> y,
                                            std::span<double> gradient) {
    const double q = std::exp(y[0]);
    gradient[0] = m * q * y[1] + force.resistance(q) * q;
    gradient[1] = m * q;
    return m * q * y[1] + force.impulse(q) - momentum_at_start - motion.external_force.impulse(t);
  };

  // s is a logarithm, so its absolute error is the relative error of the gap; an error of w of
  // tolerance / end_time kept up over the whole motion changes s by the tolerance. CVODE bounds the
  // error of a step; a tenth of what is asked leaves room for their sum.
  const double tolerance = 0.1 * motion.inertial_relative_tolerance;
  const std::array start = {std::log(motion.initial_gap),
                            motion.initial_velocity / motion.initial_gap};
  Cvode cvode(system, start, tolerance, std::array{tolerance, tolerance / motion.end_time});

  Trajectory trajectory;
  const auto add_row = [&](double t) {
    const double q = t == 0 ? motion.initial_gap : std::exp(cvode.state()[0]);
    const double u = t == 0 ? motion.initial_velocity : q * cvode.state()[1];
    trajectory.rows.push_back(
        {t, q, u, -force.resistance(q) * u, motion.external_force.value(t), {}});
  };
  add_row(0);

  auto stops = motion.external_force.jumps();
  std::erase_if(stops, [&](double t) { return t >= motion.end_time; });
  stops.push_back(motion.end_time);
  const auto times = row_times(motion);
  auto next_row = times.begin() + 1;
  double from = 0;
  for (const double stop : stops) {
    f = motion.external_force.mean(from, stop);
    if (from > 0) {
      // Where the film damps faster than t has digits, no step can resolve how u follows a jump of f: it does so at once, to its balance with
      // the drag.
      constexpr double kTimeResolution = 1e-12;
      const double q = std::exp(cvode.state()[0]);
      const double resistance = force.resistance(q);
      if (m / resistance < kTimeResolution * from)
        cvode.set_state(std::array{cvode.state()[0], f / (resistance * q)});
    }
    cvode.restart(from, stop);
    while (next_row != times.end() && *next_row <= stop) {
      const auto reached = cvode.advance(*next_row);
      // An event at the very time of a row would be a second row at that time.
      if (cvode.time() > trajectory.rows.back().time) add_row(cvode.time());
      if (reached == Cvode::Stop::kAtTime) ++next_row;
    }
    from = stop;
  }
  trajectory.steps = cvode.steps();
  return trajectory;
}

}  // namespace viscontact
