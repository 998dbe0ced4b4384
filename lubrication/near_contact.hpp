// Leading terms of force and torque on a sphere that slides, rolls or spins at a small gap q beside
// its neighbour, by lubrication theory (docs/physics.md (2.9) to (2.11)).
#pragma once

#include <optional>
#include <string_view>

#include "viscontact/lubrication/table.hpp"

namespace viscontact::lubrication {

/// The neighbour of a sphere of radius 1.
struct NeighbourSurface {
  /// Radius of the sphere over that of the neighbour [1], > -1: 0 for a plane, < 0 for a cavity
  /// around the sphere.
  double curvature = 0;
  /// The tangential stress on the neighbour is 0. Such a neighbour must be a plane at rest.
  bool is_shear_free = false;
  /// The neighbour's velocity (slide) or angular velocity (roll, spin) over that of the sphere [1].
  /// It must be 0 unless the curvature is > 0.
  double velocity_ratio = 0;
};

/// The coefficients of one term in the factors of force and torque (Action in motion_table.hpp).
struct LeadingFactors {
  /// The name of a Term: "ln q" for sliding and rolling, "q ln q" for spinning.
  std::string_view term;
  double force = 0;
  double torque = 0;
};

/// The coefficients for the motions kSlide, kRoll and kSpin, with q in sphere radii (Goldman, Cox &
/// Brenner 1967 for a plane; Jeffrey & Onishi 1984 for two spheres). The approach has no such term.
LeadingFactors leading_factors(MotionKind motion, const NeighbourSurface& neighbour);

/// The coefficients of the most singular term in the factors of a body; nothing for a load that is
/// 0 by symmetry.
struct ActionFactors {
  std::optional<double> force, torque, stresslet;
};

/// Of a sphere and of its neighbour at rest, by pair_near_contact.hpp, whose term is 1/q in axial
/// flows, ln q across the axis, and q ln q in the other ones, with q in sphere radii. `curvature`
/// is the radius of the sphere over that of the neighbour [1], >= 0; the neighbour has none if it
/// is 0.
struct LeadingLoads {
  ActionFactors sphere, neighbour;
};
LeadingLoads leading_loads(MotionKind motion, double curvature);

}  // namespace viscontact::lubrication
