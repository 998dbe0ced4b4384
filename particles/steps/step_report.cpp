// Collects the residuals of a time step, which measure how far its solution misses the conditions
// of contacts and links, and refuses a step with a deep overlap (step_report.hpp). Gaps, residuals
// and the mean radius (> 0, not checked) are lengths [L], impulses and their residuals are [M L/T],
// in the units of the case file. In the report, residuals of gaps are divided by the mean radius,
// and those of impulses by the impulse at work, which is the largest impulse that acts on the less
// loaded particle of a contact; all are numbers >= 0. A residual that is not a number makes
// `excess` infinite and `converged` false. Only refuse_deep_overlap() throws: Error(kNotConverged).
// simulation.cpp, projection/ and fluid/ use this file. A change must keep that particles with
// masses and particles in a fluid are measured in the same way.
#include "viscontact/particles/steps/step_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "viscontact/common/error.hpp"

namespace viscontact::particles {

/// Takes a residual >= 0 [L] into account. The largest allowed residual is `allowed` > 0 [L].
/// Returns true if the residual is larger or not a number.
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

/// Takes a residual of an impulse >= 0 [M L/T] into account; ignores it if the impulse at work,
/// `at_work` [M L/T], is 0.
void StepResiduals::take_impulse(double residual, double at_work) {
  if (at_work > 0) of_impulses = std::max(of_impulses, residual / at_work);
}

/// Takes the gap of a pair after the step into account [L]; a gap that is not a number counts as
/// the smallest gap.
void StepResiduals::take_gap(double gap, const Pair& pair) {
  if (gap >= smallest_gap || std::isnan(smallest_gap)) return;
  smallest_gap = gap;
  deepest_overlap = pair;
}

/// Enters the residuals of a step, or of a part of it, in the report, where the larger value stays.
/// `excess` becomes infinite if the step has not converged although no residual is above what is
/// allowed.
void report_residuals(const StepResiduals& residuals, double mean_radius, StepReport& report) {
  report.residual = std::max(report.residual, residuals.largest / mean_radius);
  report.impulse_residual = std::max(report.impulse_residual, residuals.of_impulses);
  report.converged = report.converged && residuals.converged;
  report.excess = std::max(report.excess, residuals.converged || residuals.excess > 1
                                              ? residuals.excess
                                              : std::numeric_limits<double>::infinity());
  report.largest_overlap =
      std::max(report.largest_overlap, (0 - residuals.smallest_gap) / mean_radius);
}

/// Throws Error(kNotConverged) if the step that ends at `time` [T] has not converged and leaves an
/// overlap of more than the mean radius, a free choice. `reason` returns the end of the message.
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

/// The name of a pair in messages, with the ids of its particles; obstacles are numbered from 1.
std::string name_of_pair(const Pair& pair, const Particles& particles, const Setting& setting) {
  const auto id = [&](std::int32_t k) { return particles.id(index_of(k)); };
  if (pair.first >= 0) return fmt::format("particles {} and {}", id(pair.first), id(pair.second));
  const bool has_walls = obstacles_of(setting).size() > setting.planes.size();
  return fmt::format("particle {} and {} {}", id(pair.second), has_walls ? "obstacle" : "plane",
                     -pair.first);
}

}  // namespace viscontact::particles
