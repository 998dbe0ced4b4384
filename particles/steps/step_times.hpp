// The grid of time steps, docs/physics.md (5.10): where each step of a simulation ends. Times [T]
// are in the unit of the case. Both simulations use it. A change must keep the ends of steps bit
// for bit, because a run that continues must take the same steps as one that was not interrupted.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/setting.hpp"
#include "viscontact/particles/state.hpp"

namespace viscontact::particles {

/// Times > 0 at which steps of a case must end or be centred [T], increasing, each once. With the
/// leapfrog scheme they are those at which a force or torque jumps. Otherwise, if solids rebound,
/// they are those at which the velocity of a plane jumps, because a plane moves evenly in a step;
/// else there are none.
std::vector<double> jump_times(const Setting& setting);

/// The end of the step from `time` with Scheme::kLeapfrog, which without jumps is `grid_end`, one
/// time step `h` later at most.
///
/// Velocities stand in the middles of steps, so that the impulse of a step is that of the forces
/// from the middle of the step before to its own. If a force jumped from pull to push in between,
/// both would cancel in this impulse, although the film, whose gamma has bounds, would have
/// absorbed them one after the other. Steps near a jump are therefore shortened to between h/4 and
/// 3 h/4 such that the jump is in the middle of one. Of jumps that follow each other within h/2
/// only the first is resolved.
double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps);

/// The next step of a simulation.
struct StepInterval {
  double h = 0;              ///< length [T], > 0; exactly the time step for a step on the grid
  double end = 0;            ///< time at which it ends [T]
  bool reaches_end = false;  ///< whether the run ends here, within rounding errors of times
  /// If the step does not end on the grid: where the grid begins anew (State::grid_time) [T].
  std::optional<double> new_grid{};
};

/// The grid of the steps of a simulation.
class StepGrid {
 public:
  /// `time_step` > 0 is the length h of a step, and `jumps` are the jump_times(). With `leapfrog`,
  /// steps are placed around them (leapfrog_step_end()); otherwise a step ends at each of them.
  explicit StepGrid(double time_step, bool leapfrog = false, std::vector<double> jumps = {})
      : time_step_(time_step), leapfrog_(leapfrog), jumps_(std::move(jumps)) {}

  /// The step that begins at `state`. It ends at `end` if that is earlier than the end of a whole
  /// step by more than a millionth of h. Nothing if less than a millionth of h is left until `end`:
  /// rounding errors of the times would otherwise cause tiny steps.
  std::optional<StepInterval> next(const State& state, double end) const;

  /// Counts the step that is done in `state`, and moves the grid if the step did not end on it.
  static void count(State& state, const StepInterval& step);

 private:
  double time_step_;
  bool leapfrog_;
  std::vector<double> jumps_;
};

}  // namespace viscontact::particles
