// Computes by lubrication theory (docs/physics.md (2.9) to (2.11)) how force and torque on a sphere
// depend on a small gap q beside another body, its neighbour, when the sphere slides, rolls or
// spins: it gives the coefficients of the term ln q or q ln q in both. Lengths, also q, are in
// sphere radii. Nothing is checked or thrown. freefem_axi/motion_table_plan.cpp uses it and writes
// the coefficients into the head of each table. A change must keep the coefficients, which
// published tables contain.
#pragma once

#include <string_view>

#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// The neighbour of a sphere of radius 1. If the members do not obey the conditions below, results
/// have no meaning and may be infinite or NaN.
struct NeighbourSurface {
  /// Radius of the sphere over that of the neighbour [1], > -1: 0 for a plane, < 0 for a cavity
  /// around the sphere.
  double curvature = 0;
  /// True: the tangential stress on the neighbour is 0. Such a neighbour must be a plane at rest.
  bool is_shear_free = false;
  /// The neighbour's velocity (slide) or angular velocity (roll, spin) over that of the sphere [1].
  /// It has any sign, but must be 0 unless the curvature is > 0.
  double velocity_ratio = 0;
};

/// The coefficients of one term in the force factor and the torque factor, which are those of
/// motion_table.hpp. With the viscosity mu, the radius r and the velocity u of the sphere, or u = r
/// w for its angular velocity w, the force factor is force/(-6 pi mu r u) and the torque factor is
/// torque/(-8 pi mu r^2 u).
struct LeadingFactors {
  /// The name of a Term: "ln q" for sliding and rolling, "q ln q" for spinning.
  std::string_view term;
  double force = 0;   ///< in the force factor of the sphere [1], any sign
  double torque = 0;  ///< in the torque factor of the sphere [1], any sign
};

/// The coefficients for the motions kSlide, kRoll and kSpin, with q in sphere radii (Goldman, Cox &
/// Brenner 1967 for a plane; Jeffrey & Onishi 1984 for two spheres). kApproach, which has no such
/// term, is not refused, but gives the coefficients of kRoll.
LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour);

}  // namespace viscontact::lubrication
