// The motion of a particle in a fluid that a case prescribes. Lengths and times are in the units of
// the case. A particle at rest (`fixed = true` in a case) is one whose velocities are 0.
#pragma once

#include "viscontact/particles/piecewise_constant.hpp"

namespace viscontact::particles {

/// Velocities that a particle has whatever acts on it. Both are 0 after their last piece.
struct GivenMotion {
  PiecewiseConstant velocity;          ///< of the centre [L/T]
  PiecewiseConstant angular_velocity;  ///< counter-clockwise, value[2] of each piece [1/T]
};

}  // namespace viscontact::particles
