// The loop over time of the model `explicit_euler`. Scheme and units are those of
// explicit_euler.hpp. A change of its results must raise kModelsRevision.
#include "viscontact/reduced_model/models/explicit_euler.hpp"

namespace viscontact::reduced_model {

Trajectory simulate_explicit_euler(const Motion& motion,
                                   const lubrication::LubricationForce& force) {
  const double end = motion.end_time;
  const double step = motion.parameter(kContactTimeStep);
  const int steps = step_count(end, step);
  Trajectory trajectory;
  double q = motion.initial_gap;
  double u = motion.initial_velocity;
  for (int n = 0;; ++n) {
    const double t = step_time(n, steps, end, step);
    if (n % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double drag = -force.resistance(q) * u;
    trajectory.rows.push_back({t, q, u, drag, motion.external_force.value(t), {}});
    if (n == steps) break;
    const double next = step_time(n + 1, steps, end, step);
    const double h = next - t;
    const double fall = -h * u;
    ++trajectory.steps;
    if (!(q - fall > 0)) {
      // The point at which the straight line of this step crosses the wall. The drag is not defined
      // there.
      const double crossing = t + q / fall * h;
      trajectory.rows.push_back({crossing, 0, u, {}, motion.external_force.value(crossing), {}});
      break;
    }
    u += h / motion.mass * (drag + motion.external_force.mean(t, next));
    q -= fall;
  }
  return trajectory;
}

}  // namespace viscontact::reduced_model
