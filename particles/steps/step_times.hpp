// The ends of time steps: a grid of points at the distance h, except near jumps of forces, torques
// or velocities of planes, docs/physics.md (5.10).
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "viscontact/particles/setting/setting.hpp"
#include "viscontact/particles/state/state.hpp"

namespace viscontact::particles {

/// The times > 0 at which a step must end (Euler scheme) or have its middle (leapfrog scheme) [T],
/// increasing. With the leapfrog scheme a force or torque jumps at these times. With the Euler
/// scheme and a restitution the velocity of a plane or of a driven particle jumps, because the
/// computation of rebounds assumes that it moves evenly in a step. With PairLubrication the flow or
/// the given stress jumps, because a step has one of them. Otherwise the list is empty.
std::vector<double> jump_times(const Setting& setting);

/// The end of the step that begins at `time` with the leapfrog scheme [T]. If no jump is near, this
/// is `grid_end`, the next point of the grid, at most `h` later; if less than h/2 is left until
/// `grid_end`, two equal steps end at the point of the grid after it, and this is the end of the
/// first one.
///
/// In this scheme velocities belong to the middles of steps, so that the impulse of a step is the
/// integral of the forces from the middle of the step before to its own middle. If a force jumped
/// from push to pull between these times, both would cancel in this impulse, while in truth the
/// film of a contact absorbs the whole push before it is pulled. Therefore the lengths of steps
/// near a jump are chosen, usually between h/4 and h, so that the jump is in the middle of a step.
/// If jumps follow each other within h/2, only the first one is in the middle of a step.
double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps);

struct StepInterval {
  double h = 0;              ///< length [T], > 0; exactly the time step for a step on the grid
  double end = 0;            ///< [T]
  bool reaches_end = false;  ///< whether the run ends with this step, up to h/1e6
  /// Set if the step does not end on the grid: a point of the new grid (State::grid_time) [T].
  std::optional<double> new_grid{};
};

/// Computes the ends of all steps of a simulation. A run that continues from a restart file takes
/// the same steps, to the last bit, as one that was not interrupted.
class StepGrid {
 public:
  /// `time_step` is h [T], and `jumps` are the jump_times(). With `leapfrog`, steps are placed
  /// around them (leapfrog_step_end()); otherwise a step ends at each jump.
  explicit StepGrid(double time_step, bool leapfrog = false, std::vector<double> jumps = {})
      : time_step_(time_step), leapfrog_(leapfrog), jumps_(std::move(jumps)) {}

  /// The step that begins at `state`, with the rules of Simulation::step(); std::nullopt if too
  /// little time is left until `end` [T].
  std::optional<StepInterval> next(const State& state, double end) const;

  /// Times that differ less [T] are the same, with steps of the length h.
  static double tiny(double h);
  /// A function whose pieces are at least so long [T] has a step within each piece.
  static double least_piece(double h) { return 2 * tiny(h); }

  /// Counts `step` in `state`, and replaces the grid if the step did not end on it.
  static void count(State& state, const StepInterval& step);

 private:
  double time_step_;
  bool leapfrog_;
  std::vector<double> jumps_;
};

}  // namespace viscontact::particles
