// The coefficients of the terms ln q and q ln q in force and torque on a sphere that slides, rolls
// or spins at a small gap q beside another body, its neighbour, by lubrication theory
// (docs/physics.md (2.9) to (2.11)). Lengths, also q, are in sphere radii. Nothing is checked or
// thrown. Used by freefem_axi/motion_table_plan.cpp, which writes the coefficients into the head of
// each table. A change must keep the coefficients, which published tables contain.
#pragma once

#include <string_view>

#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// The neighbour of a sphere of radius 1.
struct NeighbourSurface {
  /// 1 over the neighbour's radius [1], > -1: 0 for a plane, < 0 for a cavity around the sphere.
  double curvature = 0;
  /// True: the tangential stress on the neighbour is 0; it must be a plane at rest.
  bool is_shear_free = false;
  /// The neighbour's velocity (slide) or angular velocity (roll, spin) over that of the sphere [1].
  /// It must be 0 unless the curvature is > 0.
  double velocity_ratio = 0;
};

/// The coefficients of one term. With the viscosity mu, the radius r and the velocity u of the
/// sphere, or u = r w for its angular velocity w, the force factor is force/(-6 pi mu r u) and the
/// torque factor is torque/(-8 pi mu r^2 u), as in motion_table.hpp.
struct LeadingFactors {
  /// The name of a Term: "ln q" for sliding and rolling, "q ln q" for spinning.
  std::string_view term;
  double force = 0;   ///< in the force factor of the sphere [1]
  double torque = 0;  ///< in the torque factor of the sphere [1]
};

/// The coefficients for kSlide, kRoll or kSpin (kApproach gives those of kRoll), with q in sphere
/// radii; of any sign, without meaning if `neighbour` is not as its comments say (Goldman, Cox &
/// Brenner 1967 for a plane; Jeffrey & Onishi 1984 for two spheres).
LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour);

}  // namespace viscontact::lubrication
