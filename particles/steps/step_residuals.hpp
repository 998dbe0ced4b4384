// How far the solution of a step misses its conditions, and whether the step is accepted: the same
// for particles with masses (projection/) and in a fluid (fluid/). A residual [L] is the distance
// of a gap or a length from the value that its condition demands; docs/particles.md, "The
// projection", says what is allowed. Lengths, masses and times are in the units of the case. A
// change of a limit changes which steps are accepted. Used by fluid/, projection/ and
// simulation.cpp.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"
#include "viscontact/particles/steps/step_report.hpp"

namespace viscontact::particles {

/// The residuals of all contacts and links of a step.
struct StepResiduals {
  double largest = 0;  ///< [L]
  double excess = 0;   ///< largest residual, divided by what is allowed for its contact or link
  /// Largest residual as an impulse, divided by the impulses at work in its contact or link.
  double of_impulses = 0;
  double smallest_gap = 0;  ///< smallest linearised gap after the step [L], at most 0
  Pair deepest_overlap;     ///< the pair with the smallest gap
  bool converged = true;    ///< all residuals are allowed
  /// Of each contact [M L/T], >= 0: its residual divided by its mobility Contact::w.
  std::vector<double> impulse_errors;

  /// Adds a residual >= 0 of which `allowed` > 0 is allowed [L]. Returns true if it is larger than
  /// allowed, or not a number; then `converged` becomes false.
  bool take(double residual, double allowed);
  /// Adds the residual of an impulse [M L/T]; `at_work` >= 0 are the impulses at work [M L/T].
  void take_impulse(double residual, double at_work);
  /// Adds the gap of a pair after the step [L]. A gap that is not a number stays the smallest.
  void take_gap(double gap, const Pair& pair);
};

/// Adds the residuals of a step, or of one part of a divided step, to the report. `mean_radius` > 0
/// [L].
void report_residuals(const StepResiduals& residuals, double mean_radius, StepReport& report);

/// Throws Error(kNotConverged) if a step that ends at `time` [T] has not converged and leaves an
/// overlap of more than the mean radius [L]. `reason` says what may be the cause.
void refuse_deep_overlap(const StepResiduals& residuals, const Particles& particles,
                         const Setting& setting, double mean_radius, double time,
                         const std::function<std::string()>& reason);

/// "particles 3 and 4", "particle 3 and plane 1": a pair in messages, with the ids of its
/// particles. All obstacles are called planes if the domain has no walls.
std::string name_of_pair(const Pair& pair, const Particles& particles, const Setting& setting);

}  // namespace viscontact::particles
