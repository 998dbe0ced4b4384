// Residuals of a time step.
#include "viscontact/particles/steps/step_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

bool StepResiduals::take(double residual, double allowed) {
  largest = std::max(largest, residual);
  return take_error(residual, allowed);
}

bool StepResiduals::take_error(double residual, double allowed) {
  excess = std::isnan(residual) ? std::numeric_limits<double>::infinity()
                                : std::max(excess, residual / allowed);
  const bool beyond = !(residual <= allowed);
  if (beyond) converged = false;
  return beyond;
}

void StepResiduals::take_impulse(double residual, double at_work) {
  if (at_work > 0) of_impulses = std::max(of_impulses, residual / at_work);
}

void StepResiduals::take_gap(double gap, const Pair& pair) {
  if (gap >= smallest_gap || std::isnan(smallest_gap)) return;
  smallest_gap = gap;
  deepest_overlap = pair;
}

void report_residuals(const StepResiduals& residuals, double mean_radius, StepReport& report) {
  assert(mean_radius > 0);
  report.residual = std::max(report.residual, residuals.largest / mean_radius);
  report.impulse_residual = std::max(report.impulse_residual, residuals.of_impulses);
  report.converged = report.converged && residuals.converged;
  report.excess = std::max(report.excess, residuals.converged || residuals.excess > 1
                                              ? residuals.excess
                                              : std::numeric_limits<double>::infinity());
  report.largest_overlap =
      std::max(report.largest_overlap, (0 - residuals.smallest_gap) / mean_radius);
}

void refuse_deep_overlap(const StepResiduals& residuals, const Particles& particles,
                         const Setting& setting, double mean_radius, double time,
                         const std::function<std::string()>& reason) {
  if (residuals.converged || -residuals.smallest_gap <= mean_radius) return;
  throw Error(
      ErrorKind::kNotConverged,
      "no solution of the step to time {} was found: {} would overlap by {:.3g} mean radii; {}",
      time, name_of_pair(residuals.deepest_overlap, particles, setting),
      -residuals.smallest_gap / mean_radius, reason());
}

std::string name_of_pair(const Pair& pair, const Particles& particles, const Setting& setting) {
  const auto id = [&](std::int32_t k) { return particles.id(index_of(k)); };
  if (pair.first >= 0) return fmt::format("particles {} and {}", id(pair.first), id(pair.second));
  const bool has_walls = obstacles_of(setting).size() > setting.planes.size();
  return fmt::format("particle {} and {} {}", id(pair.second), has_walls ? "obstacle" : "plane",
                     -pair.first);
}

}  // namespace viscontact::particles
