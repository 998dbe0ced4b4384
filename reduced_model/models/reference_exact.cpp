// Computes the rows of the model `reference_exact` by the equation of reference_exact.hpp. Numbers
// are in any consistent units. A motion outside the fit is an Error(kBadInput). A change of results
// must raise kModelsRevision.
#include "viscontact/reduced_model/models/reference_exact.hpp"

namespace viscontact::reduced_model {

Trajectory simulate_reference_exact(const Motion& motion,
                                    const lubrication::LubricationForce& force) {
  Trajectory trajectory;
  const double at_start = force.impulse(motion.initial_gap);
  for (const double t : row_times(motion)) {
    if (trajectory.rows.size() % kStepsBetweenProgressReports == 0) report_progress(motion, t);
    const double q = t == 0 ? motion.initial_gap
                            : force.gap_of_impulse(at_start + motion.external_force.impulse(t));
    const double f = motion.external_force.value(t);
    trajectory.rows.push_back({t, q, f / force.resistance(q), -f, f, {}});
  }
  trajectory.steps = static_cast<long>(trajectory.rows.size()) - 1;
  return trajectory;
}

}  // namespace viscontact::reduced_model
