// Decides where each time step of a simulation ends. Steps end on a grid of points at the distance
// h, except near jumps of forces, torques or velocities of planes, docs/physics.md (5.10). Times
// [T] are in the unit of the case file. Nothing is checked or thrown. simulation.cpp and fluid/
// call these functions. A change must keep the ends of steps bit for bit, because a run that
// continues from a restart file must take the same steps as one that was not interrupted.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// The times > 0 at which a step must end (Euler scheme) or have its middle (leapfrog scheme) [T],
/// increasing, without repetition. With the leapfrog scheme these are the times at which a force or
/// torque of the setting jumps. With the Euler scheme and a restitution (solids rebound) they are
/// the times at which the velocity of a plane jumps, because the computation of rebounds assumes
/// that a plane moves evenly in a step. With the Euler scheme and no restitution the list is empty.
std::vector<double> jump_times(const Setting& setting);

/// The end of the step that begins at `time` with the leapfrog scheme [T]. If no jump is near, this
/// is `grid_end`, the next point of the grid, which is at most `h` > 0 later; if less than h/2 is
/// left until `grid_end`, two equal steps end at the point of the grid after it, and this is the
/// end of the first one. `jumps` are the jump_times().
///
/// In this scheme velocities belong to the middles of steps, so that the impulse of a step is the
/// integral of the forces from the middle of the step before to its own middle. If a force jumped
/// from push to pull between these times, push and pull would cancel in this impulse. In truth the
/// film of a contact absorbs the whole push, up to a bound, before it is pulled; the computation
/// would never reach this bound. Therefore the lengths of steps near a jump are chosen, usually
/// between h/4 and h, so that the jump is in the middle of a step. If jumps follow each other
/// within h/2, only the first one is in the middle of a step.
double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps);

/// Length and end of one step of a simulation.
struct StepInterval {
  double h = 0;              ///< length [T], > 0; exactly the time step for a step on the grid
  double end = 0;            ///< time at which it ends [T]
  bool reaches_end = false;  ///< whether the run ends with this step, up to h/1e6
  /// Set if the step does not end on the grid: a point of the new grid (State::grid_time) [T].
  std::optional<double> new_grid{};
};

/// Computes the ends of all steps of a simulation.
class StepGrid {
 public:
  /// `time_step` > 0 is the length h of a step [T], and `jumps` are the jump_times(). With
  /// `leapfrog`, steps are placed around them (leapfrog_step_end()); otherwise a step ends at each
  /// jump.
  explicit StepGrid(double time_step, bool leapfrog = false, std::vector<double> jumps = {})
      : time_step_(time_step), leapfrog_(leapfrog), jumps_(std::move(jumps)) {}

  /// The step that begins at `state`. It ends at `end` [T], where the run ends, if a whole step
  /// would end later by more than a millionth of h. std::nullopt if less than a millionth of h is
  /// left until `end`, because rounding errors of the times would otherwise cause tiny steps.
  std::optional<StepInterval> next(const State& state, double end) const;

  /// Counts `step` in `state`, and replaces the grid if the step did not end on it.
  static void count(State& state, const StepInterval& step);

 private:
  double time_step_;
  bool leapfrog_;
  std::vector<double> jumps_;
};

}  // namespace viscontact::particles
