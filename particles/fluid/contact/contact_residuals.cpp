// Measures residuals of contacts in a fluid (contact_residuals.hpp). Units are those of the case.
#include "viscontact/particles/fluid/contact/contact_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viscontact::particles {

double contact_residual(const FluidContact& contact, double gap_after) {
  return std::abs(std::min(gap_after, contact.w * (contact.impulse - contact.gamma)));
}

ContactTolerances contact_tolerances(std::span<const FluidContact> contacts,
                                     std::span<const double> free_velocities, double h,
                                     const MotionLayout& layout, const SolverSettings& settings,
                                     double mean_radius, double velocity_error) {
  std::vector<double> of_particle(free_velocities.size() / layout.components, 0.0);
  const auto for_particles = [](const FluidContact& contact, const auto& visit) {
    for (const auto k : {contact.first, contact.second})
      if (k >= 0) visit(static_cast<std::size_t>(k));
  };
  for (const auto& contact : contacts) {
    if (!(contact.w > 0)) continue;
    const double after = gap_after(contact, free_velocities.data(), h, layout);
    // In a glued pair the film also pulls, so that an open gap calls for an impulse, too.
    const double stopping = (contact.gamma < 0 ? std::abs(after) : std::max(0.0, -after));
    const double impulse = std::max(std::abs(contact.impulse), stopping / contact.w);
    for_particles(contact,
                  [&](std::size_t k) { of_particle[k] = std::max(of_particle[k], impulse); });
  }
  constexpr double kGapError = 1e-14;  // rounding errors of positions
  const double rounding =
      kGapError * mean_radius + velocity_error * h * fastest(free_velocities, layout);
  ContactTolerances tolerances;
  for (const auto& contact : contacts) {
    double at_work = std::numeric_limits<double>::infinity();
    for_particles(contact, [&](std::size_t k) { at_work = std::min(at_work, of_particle[k]); });
    tolerances.at_work.push_back(at_work);
    tolerances.allowed.push_back(
        std::min(settings.tolerance * mean_radius / 2,
                 std::max(settings.impulse_tolerance * contact.w * at_work, rounding)));
  }
  return tolerances;
}

ContactResiduals measure_residuals(std::span<const FluidContact> contacts,
                                   std::span<const double> free_velocities,
                                   std::span<const double> velocities, double h,
                                   const MotionLayout& layout, const SolverSettings& settings,
                                   double mean_radius, double velocity_error) {
  const auto tolerances = contact_tolerances(contacts, free_velocities, h, layout, settings,
                                             mean_radius, velocity_error);
  ContactResiduals residuals;
  residuals.impulse_errors.resize(contacts.size());
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const auto& contact = contacts[c];
    const double after = gap_after(contact, velocities.data(), h, layout);
    residuals.smallest_gap = std::min(residuals.smallest_gap, after);
    if (!(contact.w > 0)) {
      // A contact that takes no part must not close.
      const double overlap = std::max(0.0, -after);
      residuals.largest = std::max(residuals.largest, overlap);
      residuals.converged = residuals.converged && overlap <= settings.tolerance * mean_radius / 2;
      continue;
    }
    const double residual = contact_residual(contact, after);
    residuals.impulse_errors[c] = residual / contact.w;
    residuals.largest = std::max(residuals.largest, residual);
    if (tolerances.at_work[c] > 0)
      residuals.largest_relative =
          std::max(residuals.largest_relative, residual / contact.w / tolerances.at_work[c]);
    residuals.converged = residuals.converged && residual <= tolerances.allowed[c];
  }
  return residuals;
}

}  // namespace viscontact::particles
