// Steps of (4.3) and rows of (4.2), docs/physics.md.
#include "viscontact/reduced_model/models/reference.hpp"

#include <algorithm>

#include "viscontact/common/error.hpp"

namespace viscontact::reduced_model {

Trajectory simulate_reference(const Motion& motion, const lubrication::LubricationForce& force) {
  const double h = motion.parameter(kReferenceTimeStep);
  const double end = motion.end_time;
  const int steps = step_count(end, h);

  Trajectory trajectory;
  const double last = motion_ends_at(force.largest_gap());
  trajectory.steps = steps;
  trajectory.rows.reserve(static_cast<std::size_t>(steps) + 1);
  double q = motion.initial_gap;
  for (int n = 0; n <= steps; ++n) {
    const double t = step_time(n, steps, end, h);
    if (n % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double next = n < steps ? step_time(n + 1, steps, end, h) : t + h;
    const double f = motion.external_force.mean(t, next);
    const double u = f / force.resistance(q);
    trajectory.rows.push_back({t, q, u, -f, f, {}});
    if (q >= last) {
      trajectory.steps = n;
      break;
    }
    q += (next - t) * u;
    if (n < steps && q >= force.largest_gap())
      throw Error(ErrorKind::kNotConverged,
                  "the step from time {:.6g} goes through the wall opposite (gap {:.6g} of at most "
                  "{:.6g}); take a smaller reference.time_step than {}",
                  t, q, force.largest_gap(), h);
    if (n < steps && !(q > 0))
      throw Error(ErrorKind::kNotConverged,
                  "the step from time {:.6g} goes through the plane (gap {:.3g}); take a smaller "
                  "reference.time_step than {}",
                  t, q, h);
  }
  return trajectory;
}

Trajectory simulate_reference_exact(const Motion& motion,
                                    const lubrication::LubricationForce& force) {
  Trajectory trajectory;
  const double last = motion_ends_at(force.largest_gap());
  const double at_start = force.impulse(motion.initial_gap);
  for (const double t : row_times(motion)) {
    if (trajectory.rows.size() % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double q = t == 0 ? motion.initial_gap
                            : force.gap_of_impulse(at_start + motion.external_force.impulse(t));
    const double f = motion.external_force.value(t);
    trajectory.rows.push_back({t, std::min(q, last), f / force.resistance(q), -f, f, {}});
    if (q >= last) break;
  }
  trajectory.steps = static_cast<long>(trajectory.rows.size()) - 1;
  return trajectory;
}

}  // namespace viscontact::reduced_model
