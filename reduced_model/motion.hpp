// What every model of motion is given: the sphere, its start, the external force, and the values of
// the models' parameters (physics.md (4.1)), in any consistent units.
#pragma once

#include <array>
#include <cassert>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

#include "viscontact/common/stop_token.hpp"
#include "viscontact/reduced_model/external_force/external_force.hpp"
#include "viscontact/reduced_model/model_parameter.hpp"

namespace viscontact::reduced_model {

/// Key of Motion::roughness in the case file.
inline constexpr std::string_view kRoughnessKey = "viscous_contact.roughness";

/// The motion of a sphere along the normal of a wall (physics.md (4.1)), with the gap q(t) and the
/// lubrication force F_lub: m d^2q/dt^2 = F_lub(q, dq/dt) + f_ext(t), q(0) = q0, dq/dt(0) = v0.
struct Motion {
  double mass = 0;               ///< m [M], > 0
  double initial_gap = 0;        ///< q0 [L], > 0
  double initial_velocity = 0;   ///< v0 [L/T], > 0 away from the wall
  double end_time = 0;           ///< end of the motion, which begins at time 0 [T], > 0
  ExternalForce external_force;  ///< f_ext [M L/T^2], along the outward normal

  /// Heights r1, r2 of the roughness of sphere and wall [L], >= 0; smooth surfaces if both are 0.
  std::array<double, 2> roughness = {};
  /// Values by ModelParameter::key, which parameter() reads.
  std::map<std::string_view, double> parameters{};

  /// Gaps [L], > 0, for each of which a trajectory says when it is first reached.
  std::vector<double> gaps_to_reach{};
  /// Approximate number of rows of a trajectory file (fewer_rows()), >= 2; 0: all rows.
  int output_rows = 0;
  /// report_progress() calls it with the time [T] that a model has reached; may be empty.
  std::function<void(double time)> progress{};
  /// If this token requests a stop, report_progress() throws Error(kInterrupted).
  StopToken stop{};
  /// Density of the fluid [M/L^3], >= 0; 0: not known. Only the Reynolds number depends on it.
  double fluid_density = 0;

  /// Throws Error(kBadInput) if the parameter has no value.
  double parameter(const ModelParameter& which) const;
  /// Coefficient of restitution e_d of the solids; 0 without a value of kRestitution.
  double restitution() const;
  /// Sets a parameter to a value that `which.allowed` accepts.
  void set(const ModelParameter& which, double value) { parameters[which.key] = value; }
};

/// The time step [T] with which a motion has 4000 steps, as many as in the case of the lecture of
/// A. Lefebvre (2008) that data/cases/lecture.toml repeats.
inline double default_time_step(const Motion& motion, double) { return motion.end_time / 4000; }

/// Time step h of the model `reference` [T], > 0, and spacing of the rows of models that choose
/// their steps themselves.
inline constexpr ModelParameter kReferenceTimeStep = {
    "reference.time_step",
    "time step of the reference, row spacing of reference_exact and inertial",
    "T",
    kPositive,
    default_time_step,
    true,
    "`end_time`/4000"};
/// Time step h of the contact models and of the model `explicit_euler` [T], > 0.
inline constexpr ModelParameter kContactTimeStep = {"viscous_contact.time_step",
                                                    "time step of the contact models",
                                                    "T",
                                                    kPositive,
                                                    default_time_step,
                                                    true,
                                                    "`end_time`/4000"};

/// Coefficient e_d of restitution of the solids [1], 0 to 1.
inline constexpr ModelParameter kRestitution = {
    "viscous_contact.restitution",
    "coefficient of restitution of the solids",
    "1",
    {[](double v) { return v >= 0 && v <= 1; }, "from 0 to 1"},
    [](const Motion&, double) { return 0.0; },
    false,
    "0"};

/// Models report the time that they have reached. Throws Error(kInterrupted) at a stop.
void report_progress(const Motion& motion, double time);

/// Number of steps between two calls of report_progress() in a model whose steps are cheap: they
/// take about 0.1 ms, so that the calls cost little and a stop acts at once.
inline constexpr int kStepsBetweenProgressReports = 4096;

/// Number of steps, >= 1, of length `step` > 0 [T] that cover the times from 0 to `end` [T]. The
/// last step may be shorter. A last step of less than 1e-6 `step` is dropped, because it is a
/// rounding error of end/step. Throws Error(kBadInput) if there are more than 1e8 steps, or if
/// end/step is not a number.
int step_count(double end, double step);

/// The time [T] after `index` of the `count` steps; after the last step it is exactly `end`.
inline double step_time(int index, int count, double end, double step) {
  assert(0 <= index && index <= count);
  return index == count ? end : index * step;
}

/// The gap at which every model ends the motion where a wall stands opposite, 1e-9 below the gap
/// `largest_gap` at which the sphere touches it: models that resolve the drag approach this wall
/// without end, and doubles cannot resolve a much thinner film there.
inline double motion_ends_at(double largest_gap) { return largest_gap * (1 - 1e-9); }

/// The times of the rows of a model without a fixed step: 0, the multiples of `parameter`, the
/// jumps of the force or of its slope, and end_time, in increasing order. A multiple is left out if
/// it differs from a jump by less than 1e-6 times `parameter`. Throws Error(kBadInput) if
/// `parameter` has no value or if there are more than 1e8 multiples.
std::vector<double> row_times(const Motion& motion,
                              const ModelParameter& parameter = kReferenceTimeStep);

}  // namespace viscontact::reduced_model
