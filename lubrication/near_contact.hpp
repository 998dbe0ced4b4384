// What lubrication theory says of forces and torques near contact if a sphere slides, rolls or
// spins beside its neighbour (physics.md (2.9) to (2.11)). Lengths, also the gap q, are in sphere
// radii. The tabulation of motions writes these coefficients into the head of its tables. Nothing
// is thrown: the caller gives a motion and a neighbour that are allowed. Used by freefem_axi/.
#pragma once

#include <string_view>

#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// The neighbour of a sphere of radius 1: its properties on which the film between them depends.
struct NeighbourSurface {
  /// 1 over the neighbour's radius [1]: 0 of a plane, < 0 of a cavity; > -1.
  double curvature = 0;
  /// True: no tangential stress on the neighbour, which is then a plane at rest.
  bool is_shear_free = false;
  /// The neighbour's velocity over that of the sphere, in the same motion [1]. Unless the curvature
  /// is > 0, it must be 0.
  double velocity_ratio = 0;
};

/// Coefficients of the leading singular term. Factors are those of a table of this motion
/// (motion_table.hpp).
struct LeadingFactors {
  /// The name of a Term: "ln q" for sliding and rolling, "q ln q" for spinning.
  std::string_view term;
  double force = 0;   ///< in the force factor of the sphere [1]
  double torque = 0;  ///< in the torque factor of the sphere [1]
};

/// The leading coefficients of a motion across the axis or around it (kSlide, kRoll, kSpin), with q
/// in sphere radii (Goldman, Cox & Brenner 1967 for a plane; Jeffrey & Onishi 1984 for two
/// spheres).
LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour);

}  // namespace viscontact::lubrication
