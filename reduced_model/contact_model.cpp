#include "reduced_model/contact_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reduced_model/contact_step.hpp"

namespace viscontact {

ContactModel contact_with_leading_term(const Motion& motion, const LubricationForce& force) {
  const double k = force.leading_coefficient();
  const double r = force.radius();
  const double solid_gap = motion.roughness[0] + motion.roughness[1];
  ContactModel model;
  model.gamma_min = solid_gap == 0 ? -std::numeric_limits<double>::infinity()
                                   : std::min(0.0, k * std::log(solid_gap / r));
  model.film_thickness = [k, r](double gamma) { return r * std::exp(gamma / k); };
  return model;
}

Trajectory run_contact_model(const Motion& motion, const ContactModel& model) {
  const double m = motion.mass;
  const double end = motion.end_time;
  const int steps = step_count(end, motion.contact_time_step);

  Trajectory trajectory;
  trajectory.steps = steps;
  trajectory.rows.reserve(static_cast<std::size_t>(steps) + 1);
  ContactState state{motion.initial_gap - model.contact_gap, motion.initial_velocity, 0};
  trajectory.rows.push_back({0, motion.initial_gap, state.velocity,
                             -model.resolved_resistance(motion.initial_gap) * state.velocity,
                             motion.external_force.value(0), state.gamma});
  double lowest_gamma = 0;
  for (int n = 0; n < steps; ++n) {
    const double t = step_time(n, steps, end, motion.contact_time_step);
    const double next = step_time(n + 1, steps, end, motion.contact_time_step);
    const double h = next - t;
    const double f = motion.external_force.mean(t, next);
    const double resistance = model.resolved_resistance(model.contact_gap + state.gap);
    // Drag implicit in the velocity after the projection: m (u^{n+1} - u^n)/h = f - R u^{n+1} + lambda. So without
    // contact the velocity is the following, and what a contact has to change weighs m + h R.
    const double inertia = m + h * resistance;
    const double free_velocity = (m * state.velocity + h * f) / inertia;
    const ContactState after = contact_step(state, free_velocity, inertia, model.gamma_min, h);
    const double film_force = (state.gamma - after.gamma) / h;
    trajectory.rows.push_back({next, model.contact_gap + after.gap, after.velocity,
                               film_force - resistance * after.velocity,
                               motion.external_force.value(next), after.gamma});
    lowest_gamma = std::min(lowest_gamma, after.gamma);
    state = after;
  }
  if (lowest_gamma < 0) trajectory.recovered_minimal_gap = model.film_thickness(lowest_gamma);
  return trajectory;
}

}  // namespace viscontact
