// Where the steps of a simulation end, docs/physics.md (5.10). Times are in the unit of the case.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "viscontact/particles/piecewise_constant.hpp"

namespace viscontact::particles {

/// Times > 0 at which one of the functions jumps, increasing, each once.
std::vector<double> jump_times(std::span<const PiecewiseConstant* const> functions);

/// The end of the step from `time` with Scheme::kLeapfrog, which without jumps is `grid_end`, one
/// time step `h` later at most.
///
/// Velocities stand in the middles of steps, so that the impulse of a step is that of the forces
/// from the middle of the step before to its own. If a force jumped in between, pull and push would
/// cancel before a film books them, although its gamma has bounds. Steps near a jump are therefore
/// shortened to between h/4 and 3 h/4 such that the jump is in the middle of one. Of jumps that
/// follow each other within h/2 only the first is resolved.
double leapfrog_step_end(double time, double grid_end, double h, std::span<const double> jumps);

}  // namespace viscontact::particles
