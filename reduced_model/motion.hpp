// What the models of motion are given: the sphere, the start, the force, and each model's numerical
// settings.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "viscontact/reduced_model/external_force.hpp"

namespace viscontact {

/// The motion of a sphere along the normal of a plane: m d^2q/dt^2 = F_lub(q, dq/dt) + f_ext(t),
/// q(0) = q0, dq/dt(0) = v0.
struct Motion {
  double mass = 0;              ///< m [M], > 0
  double initial_gap = 0;       ///< q0 [L], > 0
  double initial_velocity = 0;  ///< v0 [L/T]
  double end_time = 0;          ///< [T], > 0
  ExternalForce external_force;

  double reference_time_step = 0;  ///< h of `reference` [T], > 0; also the spacing of the rows of
                                   ///< `reference_exact` and `inertial`
  double inertial_relative_tolerance = 0;  ///< of ln q and dq/dt / q; in [1e-13, 1e-2]
  double contact_time_step = 0;  ///< h of the contact models and `explicit_euler` [T], > 0
  std::array<double, 2> roughness =
      {};  ///< r1, r2: roughness heights of sphere and plane [L], >= 0; both 0: smooth
  double threshold_gap = 0;  ///< q_c of `viscous_contact_threshold` [L], > 0

  int output_rows =
      0;  ///< about how many rows a trajectory file has (fewer_rows.hpp), at least 2; 0: all
  /// Told the time [T] that a model has reached, now and then, by report_progress(); may be empty.
  std::function<void(double time)> progress{};
};

/// What a model calls now and then with the time that it has reached: tells motion.progress, and
/// throws Error(kInterrupted) after Ctrl-C.
void report_progress(const Motion& motion, double time);

/// How many cheap steps a model takes between two calls of report_progress(): some 0.1 ms.
inline constexpr int kStepsBetweenProgressReports = 4096;

/// Number of steps of size `step` that cover [0, end]; the last one may be shorter, and one that
/// would be shorter than a millionth of a step is left to round-off.
int step_count(double end, double step);

/// The time after `index` of those steps, `end` at the last.
inline double step_time(int index, int count, double end, double step) {
  return index == count ? end : index * step;
}

/// The times of the rows of a model that needs no fixed step: 0, every `spacing`, the force's jumps, end_time.
std::vector<double> row_times(const Motion& motion, double spacing);

/// With spacing reference_time_step.
std::vector<double> row_times(const Motion& motion);

}  // namespace viscontact
